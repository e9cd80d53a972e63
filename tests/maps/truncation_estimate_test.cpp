#include "hamjet/maps/truncation_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

// Against series in one variable whose remainder has a closed form.

namespace hamjet {
namespace {

using Support = TruncationEstimate::Support;

/// The estimate for the terms d_1, d_2, ..., d_N, all of one sign and the same for state and
/// position.
TruncationEstimate estimate(const std::vector<double>& terms) {
  DegreeShares shares;
  const std::size_t n = terms.size();
  double lower = 0;
  for (std::size_t i = 0; i + 2 < n; ++i) lower += terms[i];
  shares.lower = {lower, lower};
  if (n > 1) shares.last_but_one = {terms[n - 2], terms[n - 2]};
  shares.last = {terms[n - 1], terms[n - 1]};
  return estimate_truncation(static_cast<int>(n), shares);
}

std::vector<double> powers(double x, int n) {
  std::vector<double> terms;
  for (int k = 1; k <= n; ++k) terms.push_back(std::pow(x, k));
  return terms;
}

TEST(TruncationEstimate, OfAGeometricSeriesIsItsRemainder) {
  for (int n = 2; n <= 6; ++n) {
    for (const double x : {1e-3, 0.01, 0.1, 0.3}) {
      const TruncationEstimate result = estimate(powers(x, n));
      const double remainder = std::pow(x, n + 1) / (1 - x);
      EXPECT_EQ(result.support, Support::inside);
      // The estimate reads d_1 from the sum of the lower degrees, which can only lower the mean
      // decay.
      EXPECT_NEAR(result.miss, remainder, 1e-9 * remainder) << n << " " << x;
    }
  }
}

// The terms are 0.3^k, but one of the degrees vanishes by chance or is a thousandth of its expected
// size.
TEST(TruncationEstimate, DecayIsNotDecidedByOneSmallDegree) {
  constexpr double x = 0.3;
  for (const double part : {1.0, 1e-3, 0.0}) {
    EXPECT_NEAR(decay_of_degrees(2, x, x * x, part * x * x * x), x, 1e-12) << part;
  }
  EXPECT_NEAR(decay_of_degrees(2, x, 0, x * x * x), x, 1e-12);
  EXPECT_NEAR(decay_of_degrees(2, x, 1e-3 * x * x, x * x * x), x, 1e-12);
  EXPECT_EQ(decay_of_degrees(2, x, 0, 0), 0);
  EXPECT_NEAR(decay_of_degrees(1, x, x, x * x), x, 1e-12);
}

TEST(TruncationEstimate, OfTheExponentialSeriesIsAboveItsRemainder) {
  // The ratios x / k fall, so that the last ratio is larger than the following ones.
  for (const double x : {0.01, 0.1, 0.5}) {
    std::vector<double> terms;
    double remainder = std::exp(x) - 1;
    double term = 1;
    for (int k = 1; k <= 4; ++k) {
      terms.push_back(term *= x / k);
      remainder -= term;
    }
    const TruncationEstimate result = estimate(terms);
    EXPECT_EQ(result.support, Support::inside);
    EXPECT_GT(result.miss, remainder);
    EXPECT_LT(result.miss, 10 * remainder);
  }
}

TEST(TruncationEstimate, HonestForOddSeries) {
  // x + x^3 + x^5 + ...: cut at an even degree the last share is zero, and the miss is not.
  for (const double x : {0.01, 0.1, 0.3}) {
    for (int n = 3; n <= 6; ++n) {
      std::vector<double> terms;
      for (int k = 1; k <= n; ++k) terms.push_back(k % 2 == 1 ? std::pow(x, k) : 0);
      const int next = n % 2 == 1 ? n + 2 : n + 1;
      const double remainder = std::pow(x, next) / (1 - x * x);
      const TruncationEstimate result = estimate(terms);
      EXPECT_EQ(result.support, Support::inside) << n << " " << x;
      EXPECT_GE(result.miss, 0.99 * remainder) << n << " " << x;
      EXPECT_LE(result.miss, 2 * remainder / x) << n << " " << x;
    }
  }
}

TEST(TruncationEstimate, OutsideWhereTheDegreesDoNotDecay) {
  for (const auto& terms : std::vector<std::vector<double>>{{1, 1, 1, 1},
                                                            {1, 2, 4, 8},
                                                            {1, 0.2, 0.3, 0.5},
                                                            {1, 0.9, 0.8, 0.7},
                                                            {1, 1.1},
                                                            {1, 0.1, 0.2, 0.2},
                                                            {0, 0, 0.1, 0.01},
                                                            {0, 0.1},
                                                            {1, 0, 2}}) {
    const TruncationEstimate result = estimate(terms);
    EXPECT_EQ(result.support, Support::outside) << ::testing::PrintToString(terms);
    EXPECT_TRUE(std::isinf(result.miss));
  }
}

TEST(TruncationEstimate, NothingMissesWhereNothingIsNonlinear) {
  EXPECT_EQ(estimate({1, 0, 0, 0}).support, Support::inside);
  EXPECT_EQ(estimate({1, 0, 0, 0}).miss, 0);
  EXPECT_EQ(estimate({0, 0, 0}).miss, 0);
}

TEST(TruncationEstimate, UnknownFromOneDegreeOrNumbersThatAreNotFinite) {
  EXPECT_EQ(estimate({1}).support, Support::unknown);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    EXPECT_EQ(estimate({bad, 0.1, 0.01}).support, Support::unknown);
    EXPECT_EQ(estimate({1, bad, 0.01}).support, Support::unknown);
    EXPECT_EQ(estimate({1, 0.1, bad}).support, Support::unknown);
    EXPECT_TRUE(std::isinf(estimate({1, 0.1, bad}).miss));
  }
}

}  // namespace
}  // namespace hamjet
