#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "support/errors.hpp"

// Spaces whose variables have no products with each other. The expected values are the pure powers
// of the same functions in the full space, because the ideal of the mixed monomials does not
// influence them.

namespace hamjet {
namespace {

std::vector<std::uint8_t> power(std::size_t variables, std::size_t variable, int degree) {
  std::vector<std::uint8_t> exponents(variables, 0);
  exponents[variable] = static_cast<std::uint8_t>(degree);
  return exponents;
}

TEST(UncoupledSpace, HasThePowersOfEachVariable) {
  for (std::size_t variables = 1; variables <= 4; ++variables) {
    const SpacePointer space = SeriesSpace::create_uncoupled(variables, 5);
    EXPECT_EQ(space->size(), 1 + 5 * variables);
    for (int d = 1; d <= 5; ++d) {
      ASSERT_EQ(space->count(d), variables);
      for (std::size_t v = 0; v < variables; ++v) {
        const std::size_t k = space->first(d) + v;
        const auto e = space->exponents(k);
        EXPECT_EQ(std::vector<std::uint8_t>(e.begin(), e.end()), power(variables, v, d));
        EXPECT_EQ(space->index(power(variables, v, d)), k);
        EXPECT_EQ(space->degree(k), d);
      }
    }
  }
}

TEST(UncoupledSpace, IsAnotherThanTheCoupledOneButInOneVariable) {
  EXPECT_FALSE(*SeriesSpace::create(2, 3) == *SeriesSpace::create_uncoupled(2, 3));
  EXPECT_TRUE(*SeriesSpace::create(1, 3) == *SeriesSpace::create_uncoupled(1, 3));
  EXPECT_TRUE(SeriesSpace::create_uncoupled(3, 2)->next_order()->is_uncoupled());
}

/// Every operation that integrators use, on two series with a constant term of about one.
std::vector<Series<double>> functions(const Series<double>& a, const Series<double>& b) {
  return {a * b,  square(a), a / b,  pow(a, -1.5), pow(b, 2.5), 1.0 / a,
          exp(a), log(a),    sin(b), cos(b),       sqrt(a * b)};
}

TEST(UncoupledSpace, HoldsThePurePowersOfFunctions) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> numbers(-0.5, 0.5);
  for (std::size_t variables = 1; variables <= 3; ++variables) {
    const int order = 7;
    const SpacePointer full = SeriesSpace::create(variables, order);
    const SpacePointer lines = SeriesSpace::create_uncoupled(variables, order);
    std::vector<Series<double>> of_full(2, Series<double>(full));
    std::vector<Series<double>> of_lines(2, Series<double>(lines));
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t k = 0; k < full->size(); ++k) of_full[s][k] = numbers(generator);
      of_full[s][0] = of_lines[s][0] = 1 + 0.1 * static_cast<double>(s);
      for (std::size_t k = 1; k < lines->size(); ++k) {
        of_lines[s][k] = of_full[s][full->index(lines->exponents(k))];
      }
    }
    const auto expected = functions(of_full[0], of_full[1]);
    const auto values = functions(of_lines[0], of_lines[1]);
    for (std::size_t f = 0; f < values.size(); ++f) {
      for (std::size_t k = 0; k < lines->size(); ++k) {
        const double wanted = expected[f][full->index(lines->exponents(k))];
        // The values are sums of up to a hundred terms, each at most of the size of the largest
        // coefficient.
        EXPECT_NEAR(values[f][k], wanted, 1e-13 * (1 + std::abs(wanted)))
            << "function " << f << ", coefficient " << k << " of " << variables << " variables";
      }
    }
  }
}

TEST(UncoupledSpace, CountsItsProducts) {
  const SpacePointer space = SeriesSpace::create_uncoupled(2, 4);
  // For each variable the products are a_1 b_3, a_2 b_2, a_3 b_1; a square has a_1 a_3 only once.
  EXPECT_EQ(space->products(4).multiply_adds, 6u);
  EXPECT_EQ(space->products(4).square_multiply_adds, 4u);
  EXPECT_EQ(space->products(1).multiply_adds, 0u);
}

TEST(UncoupledSpace, RefusesWhatNeedsMixedMonomials) {
  const SpacePointer space = SeriesSpace::create_uncoupled(2, 3);
  test::expect_error(ErrorKind::usage, "vanish", [&] {
    (void)space->index(std::vector<std::uint8_t>{1, 1});
  });
  test::expect_error(ErrorKind::usage, "no derivatives", [&] { (void)space->raised(0); });
  test::expect_error(ErrorKind::usage, "different spaces",
                     [&] { require_same_space(*space, *SeriesSpace::create(2, 3)); });
}

}  // namespace
}  // namespace hamjet
