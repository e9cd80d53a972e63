#include "hamjet/uncertainty/least_separations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "relative_orbits.hpp"

namespace hamjet {
namespace {

// Parallel vectors of one size e, and an offset along the orbit of mean 0 and deviation 2 e:
//
//   d^2 = e^2 + (T_0 + 2 e sin t)^2 ,
//
// least e where |T_0| < 2 e, and sqrt(e^2 + (|T_0| - 2 e)^2) beyond.
TEST(LeastSeparations, OfARelativeEllipseAreItsOwn) {
  constexpr double e = 1e-7, sigma = 2 * e;
  EncounterProblem problem = test::RelativeOrbit{e, e, 0, 0}.problem(7, 2);
  problem.radius = 1.2 * e;
  problem.spacecraft[1].factor.col(0) = test::RelativeOrbit::along_the_orbit(sigma);
  CollisionSettings settings;
  settings.samples = 20000;
  settings.confidence = 0.9999;
  const LeastSeparations least = least_separations(problem, settings, {0.3, 0.9}, 8);
  // The cubics between nodes are right to a hundredth of the radius.
  const double accuracy = 0.01 * problem.radius;
  EXPECT_NEAR(least.separations[0], e, accuracy);
  EXPECT_NEAR(least.upper[0] - least.lower[0], 0, accuracy);
  constexpr double z = 1.6448536269514722;  // P(|x| < z) = 0.9
  const double expected = std::hypot(e, z * sigma - 2 * e);
  EXPECT_LT(least.lower[1] - accuracy, expected);
  EXPECT_GT(least.upper[1] + accuracy, expected);
  // Of the density of |x| at z, 2 phi(z) = 0.2062, the interval is 2 * 3.89 sqrt(0.9 0.1 / n) /
  // 0.2062 wide in x, of which the separation has the part sigma (z sigma - 2 e) / d.
  const double width =
      2 * 3.89 * std::sqrt(0.09 / 20000) / 0.2062 * sigma * (z * sigma - 2 * e) / expected;
  EXPECT_NEAR((least.upper[1] - least.lower[1]) / width, 1, 0.15);
  const double offset = 2 * e + std::sqrt(problem.radius * problem.radius - e * e);
  const double probability = std::erf(offset / (sigma * std::sqrt(2.0)));
  EXPECT_LT(least.lower_nearer - 0.01, probability);
  EXPECT_GT(least.upper_nearer + 0.01, probability);
  EXPECT_NEAR(static_cast<double>(least.nearer) / static_cast<double>(least.samples), probability,
              0.02);
  EXPECT_EQ(least.flights, 8);
  EXPECT_LT(least.flight_difference, accuracy);
}

// Of 64 samples the interval of the median lies between the order statistics that the binomial
// distribution says: with n = 64 and p = 1/2, P(B <= 23) = 0.0164 and P(B <= 24) = 0.0300, so that
// the 24th and the 41st sample enclose it with a confidence of 95 %; of the share 0.001 nothing is
// known below the first, and of 0.999 nothing above the last.
TEST(LeastSeparations, HaveIntervalsOfOrderStatistics) {
  EncounterProblem problem = test::RelativeOrbit{1e-7, 1e-7, 0, 1e-6}.problem(7, 1);
  problem.radius = 1e-8;
  problem.spacecraft[1].factor.col(0) = test::RelativeOrbit::along_the_orbit(1e-7);
  CollisionSettings settings;
  settings.samples = 64;
  // Quantiles at the middle of each order statistic's share give the samples themselves.
  std::vector<double> shares;
  for (int k = 0; k < 64; ++k) shares.push_back((k + 0.5) / 64);
  shares.push_back(0.5);
  shares.push_back(0.001);
  shares.push_back(0.999);
  const LeastSeparations least = least_separations(problem, settings, shares);
  ASSERT_EQ(least.samples, 64);
  EXPECT_EQ(least.lower[64], least.separations[23]);
  EXPECT_EQ(least.upper[64], least.separations[40]);
  EXPECT_EQ(least.lower[65], 0);
  EXPECT_EQ(least.upper[66], std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hamjet
