#include "hamjet/detail/algebra/monomial_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "hamjet/algebra/extended.hpp"

// The expected value is the same sum in extended precision.

namespace hamjet {
namespace {

TEST(MonomialValues, RoundingIsABoundWhereTermsCancel) {
  const int order = 5;
  const SpacePointer space = SeriesSpace::create(4, order);
  MonomialValues values(space);
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> numbers(-1, 1);
  double largest = 0;
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<double> point(4);
    for (double& x : point) x = 3 * numbers(generator);
    values.set_point(point);
    Series<double> series(space);
    for (std::size_t k = 1; k < space->size(); ++k) series[k] = numbers(generator);
    // The constant term cancels nearly all of the others.
    series[0] = -values.value(series, order);
    Extended exact = 0;
    for (std::size_t k = 0; k < space->size(); ++k) {
      Extended term = Extended(series[k]);
      for (std::size_t v = 0; v < 4; ++v) {
        for (int e = 0; e < space->exponents(k)[v]; ++e) term *= Extended(point[v]);
      }
      exact += term;
    }
    const double error =
        std::abs(static_cast<double>(exact - Extended(values.value(series, order))));
    const double bound = values.rounding(series, order);
    EXPECT_LE(error, bound);
    largest = std::max(largest, error / bound);
  }
  // Rounding errors add up at random: their sum is far below the bound, but not out of proportion
  // to it.
  EXPECT_GT(largest, 1e-4);
}

TEST(MonomialValues, RoundingLeavesOutHigherDegrees) {
  const SpacePointer space = SeriesSpace::create(1, 2);
  MonomialValues values(space);
  values.set_point(std::vector<double>{2});
  const Series<double> series(space, {1, -3, 100});
  // There are at most two terms of degree 1, so that the bound is 3 half epsilons of |1| + |-3 2|.
  EXPECT_DOUBLE_EQ(values.rounding(series, 1), 3 * 0x1p-53 * 7);
}

}  // namespace
}  // namespace hamjet
