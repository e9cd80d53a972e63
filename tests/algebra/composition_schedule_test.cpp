#include <gtest/gtest.h>

#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "support/direct_composition.hpp"
#include "support/errors.hpp"
#include "support/random_series.hpp"

// The composition is compared with one that goes monomial by monomial, an independent algorithm. On
// whole numbers below 2^53 neither rounds, so that they agree exactly.

namespace hamjet {
namespace {

using test::RandomNumbers;

template <class T>
std::vector<Series<T>> random_map(const SpacePointer& space, std::size_t components,
                                  RandomNumbers& random) {
  std::vector<Series<T>> map;
  for (std::size_t i = 0; i < components; ++i) {
    map.push_back(test::random_integer_series<T>(space, random, 2));
  }
  return map;
}

template <class T>
void expect_same(const std::vector<Series<T>>& outer, const std::vector<Series<T>>& inner) {
  EXPECT_EQ(test::largest_difference(compose(outer, inner), test::compose_directly(outer, inner)),
            0);
}

template <class T>
void compare(std::size_t outer_variables, int outer_order, std::size_t inner_variables,
             int inner_order, std::size_t components) {
  SCOPED_TRACE(::testing::Message() << outer_variables << " variables, order " << outer_order
                                    << ", of " << inner_variables << ", order " << inner_order
                                    << "; " << components << " components");
  RandomNumbers random(7);
  const auto outer =
      random_map<T>(SeriesSpace::create(outer_variables, outer_order), components, random);
  auto inner =
      random_map<T>(SeriesSpace::create(inner_variables, inner_order), outer_variables, random);
  inner = without_constants(std::move(inner));
  expect_same(outer, inner);
}

TEST(ComposeByHorner, AgreesWithComposition) {
  // All numbers of lanes are tried, with and without unused lanes, and blocks of every degree and
  // of none.
  for (std::size_t components = 1; components <= 11; ++components) {
    compare<double>(3, 4, 3, 4, components);
  }
  compare<double>(1, 9, 1, 9, 1);
  compare<double>(2, 6, 2, 6, 2);
  compare<double>(4, 4, 4, 4, 4);
  compare<double>(6, 4, 6, 4, 6);
  compare<double>(3, 9, 3, 9, 2);  // the largest block is not unrolled
}

TEST(ComposeByHorner, BetweenDifferentSpaces) {
  compare<double>(6, 3, 4, 3, 6);
  compare<double>(2, 5, 5, 5, 3);
  compare<double>(3, 2, 3, 6, 3);
  compare<double>(3, 6, 3, 2, 3);
}

TEST(ComposeByHorner, InExtendedPrecision) {
  compare<Extended>(3, 4, 4, 4, 5);
  compare<Extended>(2, 5, 2, 5, 1);
}

TEST(ComposeByHorner, OfAnOuterMapOfLowDegree) {
  RandomNumbers random(8);
  const auto space = SeriesSpace::create(3, 5);
  const auto inner = without_constants(random_map<double>(space, 3, random));
  auto outer = random_map<double>(space, 3, random);
  for (int d = 5; d >= 1; --d) {
    for (auto& component : outer) {
      for (double& x : component.slice(d)) x = 0;
    }
    expect_same(outer, inner);  // at last the inner series are constants
  }
}

TEST(ComposeByHorner, RefusesWhatDoesNotFit) {
  const auto space = SeriesSpace::create(2, 3);
  const std::vector<Series<double>> one(1, Series<double>::variable(space, 0));
  const std::vector<Series<double>> shifted(2, Series<double>::variable(space, 0, 1.0));
  const std::vector<Series<double>>& outer = one;
  test::expect_error(ErrorKind::usage, "as many components", [&] { compose(outer, outer); });
  test::expect_error(ErrorKind::usage, "constant term", [&] { compose(outer, shifted); });
}

TEST(HornerMultiplyAdds, CountsPairsOfMonomials) {
  // At each node of depth k, of which there are C(k+5, 5), there is a pair for each monomial of
  // degree 0..6-k of the node and each monomial of degree 1 or more of a variable's series, if
  // their degrees add up to at most 7-k. With 6, 21, 56, 126, 252, 462 monomials of degree 1..6
  // these are 17640, 5726, 1610, 371, 63, 6 pairs.
  const auto space = SeriesSpace::create(6, 6);
  EXPECT_EQ(composition_multiply_adds(6, 6, *space),
            6 * 17640 + 21 * 5726 + 56 * 1610 + 126 * 371 + 252 * 63 + 462 * 6);
  // In a linear map each variable's series is used once.
  EXPECT_EQ(composition_multiply_adds(6, 1, *space), 6 * 923);
}

}  // namespace
}  // namespace hamjet
