#include "hamjet/algebra/series_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include "support/errors.hpp"

namespace hamjet {
namespace {

std::vector<std::uint8_t> exponents_of(const SeriesSpace& space, std::size_t monomial) {
  const auto e = space.exponents(monomial);
  return {e.begin(), e.end()};
}

TEST(SeriesSpace, HasAsManyMonomialsAsTheBinomialCoefficient) {
  // C(v + N, N), from Pascal's triangle.
  std::vector<std::vector<std::size_t>> pascal(20, std::vector<std::size_t>(20, 1));
  for (std::size_t i = 1; i < 20; ++i) {
    for (std::size_t j = 1; j < 20; ++j) pascal[i][j] = pascal[i - 1][j] + pascal[i][j - 1];
  }
  for (std::size_t variables = 1; variables <= 7; ++variables) {
    for (int order = 0; order <= 6; ++order) {
      const auto space = SeriesSpace::create(variables, order);
      EXPECT_EQ(space->size(), pascal[variables][static_cast<std::size_t>(order)]);
      // The value is a quotient of rounded products, right to a few units in the last place.
      EXPECT_DOUBLE_EQ(SeriesSpace::monomial_count(variables, order),
                       static_cast<double>(space->size()));
      EXPECT_EQ(space->first(order + 1), space->size());
      EXPECT_EQ(space->count(0), 1u);
      if (order >= 1) {
        EXPECT_EQ(space->count(1), variables);
      }
    }
  }
  // Published counts for six variables: 7, 28, 210, 8008 coefficients at orders 1, 2, 4, 10.
  EXPECT_DOUBLE_EQ(SeriesSpace::monomial_count(6, 1), 7);
  EXPECT_DOUBLE_EQ(SeriesSpace::monomial_count(6, 2), 28);
  EXPECT_DOUBLE_EQ(SeriesSpace::monomial_count(6, 4), 210);
  EXPECT_DOUBLE_EQ(SeriesSpace::monomial_count(6, 10), 8008);
}

TEST(SeriesSpace, IndexIsTheInverseOfExponents) {
  for (std::size_t variables = 1; variables <= 7; ++variables) {
    const auto space = SeriesSpace::create(variables, 6);
    for (std::size_t k = 0; k < space->size(); ++k) {
      const auto e = exponents_of(*space, k);
      ASSERT_EQ(space->index(e), k) << variables << " variables";
      ASSERT_EQ(std::accumulate(e.begin(), e.end(), 0), space->degree(k));
    }
    for (std::size_t i = 0; i < variables; ++i) {
      std::vector<std::uint8_t> e(variables, 0);
      e[i] = 1;
      EXPECT_EQ(space->index(e), space->linear_index(i));
    }
  }
}

TEST(SeriesSpace, MonomialsAreGradedAndLexicographicWithinADegree) {
  for (std::size_t variables = 1; variables <= 7; ++variables) {
    const auto space = SeriesSpace::create(variables, 5);
    for (std::size_t k = 1; k < space->size(); ++k) {
      ASSERT_LE(space->degree(k - 1), space->degree(k));
      ASSERT_EQ(space->degree(space->first(space->degree(k))), space->degree(k));
      if (space->degree(k - 1) != space->degree(k)) continue;
      // Lexicographically falling, hence also distinct.
      ASSERT_GT(exponents_of(*space, k - 1), exponents_of(*space, k));
    }
  }
  using Exponents = std::vector<std::uint8_t>;
  const auto plane = SeriesSpace::create(2, 2);
  EXPECT_EQ(exponents_of(*plane, 3), (Exponents{2, 0}));
  EXPECT_EQ(exponents_of(*plane, 4), (Exponents{1, 1}));
  EXPECT_EQ(exponents_of(*plane, 5), (Exponents{0, 2}));
}

TEST(SeriesSpace, RaisesMonomialsByEachVariable) {
  for (std::size_t variables = 1; variables <= 7; ++variables) {
    for (int order = 0; order <= 5; ++order) {
      const auto space = SeriesSpace::create(variables, order);
      for (std::size_t i = 0; i < variables; ++i) {
        const auto raised = space->raised(i);
        ASSERT_EQ(raised.size(), space->first(order));
        for (std::size_t k = 0; k < raised.size(); ++k) {
          auto e = exponents_of(*space, k);
          ++e[i];
          ASSERT_EQ(exponents_of(*space, raised[k]), e) << variables << " variables";
        }
      }
    }
  }
}

TEST(SeriesSpace, KeepsTheSpaceOfTheNextOrder) {
  const auto space = SeriesSpace::create(3, 4);
  std::array<const SeriesSpace*, 2> seen{};
  {
    const std::jthread first([&] { seen[0] = space->next_order().get(); });
    const std::jthread second([&] { seen[1] = space->next_order().get(); });
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(*space->next_order(), *SeriesSpace::create(3, 5));
  test::expect_error(ErrorKind::usage, "order 61",
                     [] { (void)SeriesSpace::create(1, 60)->next_order(); });
}

TEST(SeriesSpace, ProductCostCountsEveryPairOfFactorsOnce) {
  // The pairs of monomials whose product has a degree of at most N correspond to the monomials in
  // twice as many variables, so that there are C(2v + N, N): 13, 91 and 646646 for six variables at
  // orders 1, 2 and 10.
  EXPECT_EQ(SeriesSpace::create(6, 1)->product_cost(), 13u);
  EXPECT_EQ(SeriesSpace::create(6, 2)->product_cost(), 91u);
  EXPECT_EQ(SeriesSpace::create(6, 10)->product_cost(), 646646u);
  for (std::size_t variables = 1; variables <= 7; ++variables) {
    for (int order = 0; order <= 6; ++order) {
      EXPECT_DOUBLE_EQ(static_cast<double>(SeriesSpace::create(variables, order)->product_cost()),
                       SeriesSpace::monomial_count(2 * variables, order));
    }
  }
}

TEST(SeriesSpace, SquareCostsAreNearHalfOfAProductsCosts) {
  for (std::size_t variables : {1u, 2u, 3u, 6u}) {
    const auto space = SeriesSpace::create(variables, 7);
    for (int d = 2; d <= 7; ++d) {
      const ProductSchedule& schedule = space->products(d);
      // Every unordered pair occurs at least once; a block that meets itself is formed in full.
      EXPECT_GE(2 * schedule.square_multiply_adds, schedule.multiply_adds);
      if (d % 2 == 1) {
        EXPECT_EQ(2 * schedule.square_multiply_adds, schedule.multiply_adds);
      } else if (d >= 4) {  // at degree 2 a block may meet only itself
        EXPECT_LT(schedule.square_multiply_adds, schedule.multiply_adds);
      }
    }
  }
}

TEST(SeriesSpace, RefusesSizesOutOfRange) {
  const auto create = [](std::size_t variables, int order) {
    return [=] { SeriesSpace::create(variables, order); };
  };
  test::expect_error(ErrorKind::usage, "0 variables", create(0, 3));
  test::expect_error(ErrorKind::usage, "65 variables", create(65, 1));
  test::expect_error(ErrorKind::usage, "order -1", create(6, -1));
  test::expect_error(ErrorKind::usage, "order 61", create(1, 61));
  test::expect_error(ErrorKind::too_large, "coefficients", create(12, 60));
  test::expect_error(ErrorKind::too_large, "coefficients", create(64, 60));
}

TEST(SeriesSpace, RefusesExponentsThatAreNotOneOfItsMonomials) {
  const auto space = SeriesSpace::create(2, 3);
  const std::vector<std::uint8_t> too_high{2, 2};
  const std::vector<std::uint8_t> too_many{1, 1, 1};
  test::expect_error(ErrorKind::usage, "no monomial", [&] { (void)space->index(too_high); });
  test::expect_error(ErrorKind::usage, "no monomial", [&] { (void)space->index(too_many); });
}

TEST(SeriesSpace, SpacesOfOneShapeAreInterchangeableOthersAreNot) {
  const auto a = SeriesSpace::create(3, 4);
  EXPECT_NO_THROW(require_same_space(*a, *SeriesSpace::create(3, 4)));
  for (const auto& other : {SeriesSpace::create(3, 5), SeriesSpace::create(4, 4)}) {
    test::expect_error(ErrorKind::usage, "different spaces",
                       [&] { require_same_space(*a, *other); });
  }
}

}  // namespace
}  // namespace hamjet
