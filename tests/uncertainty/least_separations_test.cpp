#include "hamjet/uncertainty/least_separations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamjet/error.hpp"
#include "relative_orbits.hpp"
#include "support/errors.hpp"
#include "uncertainty/flown_separations.hpp"

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
  // The cubics between nodes are right to a thousandth of the radius, and the theory to 1e-7.
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
  // The first eight, and the eight nearest to the first share.
  EXPECT_GE(least.flights, 8);
  EXPECT_LE(least.flights, 16);
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
  EXPECT_EQ(least.lower[64], least.separations[23] - least.errors[64]);
  EXPECT_EQ(least.upper[64], least.separations[40] + least.errors[64]);
  EXPECT_LE(least.errors[64], 1e-3 * problem.radius);
  EXPECT_EQ(least.lower[65], 0);
  EXPECT_EQ(least.upper[66], std::numeric_limits<double>::infinity());
}

// An offset of normal deviation about 2 e, in windows of whole turns:
//
//   d^2 = e^2 cos^2 t + (T_0 + 2 e sin t)^2 ,
//
// whose least value is looked for on a grid.
TEST(LeastSeparations, AreSeenInWindowsOfWholeTurns) {
  constexpr double e = 1e-6, sigma = 2e-7;
  const auto least_of = [&](double offset) {
    double least = 1;
    for (int k = 0; k < 2000; ++k) {
      const double t = 2 * std::numbers::pi * k / 2000;
      least = std::min(least, std::hypot(e * std::cos(t), offset + 2 * e * std::sin(t)));
    }
    return least;
  };
  // Nearer than that are offsets between two bounds about 2 e: where the ellipse is passed inside
  // and outside.
  const double radius = 1e-7;
  double share = 0;
  constexpr int parts = 500;
  for (int k = 0; k < parts; ++k) {
    const double x = -6 + 12 * (k + 0.5) / parts;
    if (least_of(2 * e + sigma * x) < radius) {
      share += std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi) * 12 / parts;
    }
  }
  for (const double turns : {1.0, 2.0, 3.0}) {
    EncounterProblem problem =
        test::RelativeOrbit{e, 0, 0, 2 * e}.problem(2 * std::numbers::pi * turns, 2);
    problem.radius = radius;
    problem.spacecraft[1].factor.col(0) = test::RelativeOrbit::along_the_orbit(sigma);
    CollisionSettings settings;
    settings.samples = 2000;
    settings.confidence = 0.9999;
    const LeastSeparations least = least_separations(problem, settings, {share}, 8);
    EXPECT_LT(least.lower[0], radius) << turns;
    EXPECT_GT(least.upper[0], radius) << turns;
    EXPECT_LT(least.lower_nearer, share) << turns;
    EXPECT_GT(least.upper_nearer, share) << turns;
    EXPECT_LT(least.flight_difference, 1e-3 * radius) << turns;
    // The start is of first order: its period is off by some e^2, of which turns make tens.
    EXPECT_LT(flown_separation_of_means(problem), 1e-3 * e) << turns;
  }
}

// On an ellipse of 2 e by e the least separation is e, halfway between two nodes of the sixteenths
// of a turn that begin at pi/16. What the cubic makes of it there is within its error.
TEST(LeastSeparations, HoldWhatInterpolationLeaves) {
  constexpr double e = 1e-6;
  EncounterProblem problem = test::RelativeOrbit{e, 0, 0, 0}.problem(5, 1);
  problem.from = std::numbers::pi / 16;
  problem.radius = 2 * e;
  CollisionSettings settings;
  settings.samples = 1;
  const LeastSeparations least = least_separations(problem, settings, {0.5}, 0);
  const double miss = std::abs(least.separations[0] - e);
  EXPECT_GT(miss, 1e-6 * e);
  EXPECT_LE(miss, least.errors[0]);
  EXPECT_LT(least.errors[0], 2e-3 * e);
}

// A deputy at (1, y), as fast and in the same direction as its chief on the unit circle, has 1/a =
// 2 / sqrt(1 + y^2) - 1, so that after a turn it is late by 3 pi y^2, and not further ahead than 1
// / (12 pi) = 0.0265 for any y. About y = 0.02 a linear flow takes y + d to 0.0162 + 0.623 d: one
// case in ten of a deviation of 0.02 is beyond 0.0162 + 1.28 * 0.623 * 0.02 = 0.0322.
TEST(LeastSeparations, HaveIntervalsThatHoldWhatPolynomialsLeaveOut) {
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.spacecraft[0].state = {1, 0, 0, 0, 1, 0};
  problem.spacecraft[1].state = {1, 0.02, 0, 0, 1, 0};
  problem.spacecraft[1].factor(1, 1) = 0.02;
  problem.from = 2 * std::numbers::pi - 1e-7;
  problem.to = 2 * std::numbers::pi;
  problem.radius = 0.01;
  problem.order = 1;
  problem.settings.tolerance = 1e-12;
  CollisionSettings settings;
  settings.samples = 2000;
  settings.confidence = 0.9999;
  const LeastSeparations least = least_separations(problem, settings, {0.9}, 8);
  EXPECT_NEAR(least.separations[0], 0.0322, 2e-3);
  EXPECT_LT(least.lower[0], 0.0265);
  EXPECT_GT(least.lower[0], 0);
}

/// Where a spacecraft on an ellipse with a = 1 is, after Kepler.
Eigen::Vector2d on_ellipse(double e, double time) {
  double anomaly = time;
  for (int k = 0; k < 200; ++k) {
    anomaly -= (anomaly - e * std::sin(anomaly) - time) / (1 - e * std::cos(anomaly));
  }
  return {std::cos(anomaly) - e, std::sqrt(1 - e * e) * std::sin(anomaly)};
}

// Two on one ellipse, the second a delay behind: they are nearest where they are slowest, half of
// the delay before and after apogee.
TEST(FlownSeparations, OfTwoOnOneEllipseAreThoseAtApogee) {
  constexpr double pi = std::numbers::pi, delay = 1e-3;
  for (const double e : {0.1, 0.7, 0.9}) {
    EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
    const double perigee = 1 - e, speed = std::sqrt((1 + e) / (1 - e));
    problem.spacecraft[0].state = {perigee, 0, 0, 0, speed, 0};
    const Eigen::Vector2d start = on_ellipse(e, -delay);
    const double r = start.norm();
    const double anomaly_sine = start.y() / std::sqrt(1 - e * e), anomaly_cosine = start.x() + e;
    problem.spacecraft[1].state = {
        start.x(), start.y(), 0, -anomaly_sine / r, std::sqrt(1 - e * e) * anomaly_cosine / r, 0};
    problem.to = 6 * pi;
    problem.radius = 1e-6;
    const double expected = (on_ellipse(e, pi + delay / 2) - on_ellipse(e, pi - delay / 2)).norm();
    EXPECT_NEAR(flown_separation_of_means(problem) / expected, 1, 1e-9) << e;
    // In a window without an apogee the least separation is at an end.
    problem.to = 2;
    const double at_end = (on_ellipse(e, 2) - on_ellipse(e, 2 - delay)).norm();
    EXPECT_NEAR(flown_separation_of_means(problem) / at_end, 1, 1e-9) << e;
  }
}

TEST(FlownSeparations, OfAFlightIntoTheCentreAreRefused) {
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.spacecraft[0].state = {1, 0, 0, 0, 1, 0};
  problem.spacecraft[1].state = {0.1, 0, 0, 0, 0, 0};
  problem.to = 1;
  problem.radius = 1e-6;
  test::expect_error([&] { flown_separation_of_means(problem); }, ErrorKind::numerical,
                     {"ended in the centre"}, "fall");
}

}  // namespace
}  // namespace hamjet
