#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "hamjet/uncertainty/collision_probability.hpp"
#include "relative_orbits.hpp"

// Probabilities of collision where nodes in time, polynomials or the begin of a window may deceive.

namespace hamjet {
namespace {

CollisionSettings samples(long count) {
  CollisionSettings s;
  s.samples = count;
  s.threads = 2;
  return s;
}

// A relative ellipse that passes through the chief itself three quarters of a turn after the start,
// across a normal component of deviation s sin t: its least distance is |s| there, to the part
// e^2/s of second order, of which the square counts. The energy is the chief's, so that the motion
// repeats to rounding at the nodes of windows of whole turns.
TEST(CollisionIntervals, SeesEncountersInWindowsOfWholeTurns) {
  constexpr double e = 1e-4, s = 5e-7, pi = std::numbers::pi;
  const double expected = std::erf(2 / std::sqrt(2.0));
  for (const double window : {2 * pi, 4 * pi, 5 * pi, 8 * pi}) {
    EncounterProblem problem = test::RelativeOrbit{e, 0, 0, 2 * e}.problem(window, 2);
    std::vector<double>& deputy = problem.spacecraft[1].state;
    deputy[4] = std::sqrt(2 / std::hypot(deputy[0], deputy[1]) - 1 - deputy[3] * deputy[3]);
    problem.radius = 2 * s;
    problem.spacecraft[1].factor(5, 5) = s;
    const CollisionProbability result = collision_probability(problem, samples(10'000));
    EXPECT_NEAR(result.probability, expected, 4 * result.standard_error + 1e-3) << window;
    EXPECT_LE(result.lower, expected + 1e-3) << window;
    EXPECT_GE(result.upper, expected - 1e-3) << window;
  }
}

// On the unit circle a deputy at (1, y), as fast and in the same direction as the chief, has 1/a =
// 2 / sqrt(1 + y^2) - 1: to first order in y it comes back after a turn of the chief, and in truth
// it is late by 3 pi y^2. The time and both bounds on y are by Kepler's equation.
class LateDeputy {
 public:
  /// The distance from the chief at the end of a turn.
  static double distance(double y) {
    const double r = std::hypot(1, y), a = 1 / (2 / r - 1), turn = 2 * std::numbers::pi;
    // r.v = y, and e sin E = r.v / sqrt(a), e cos E = 1 - r/a.
    const double sine = y / std::sqrt(a), cosine = 1 - r / a;
    const double e = std::hypot(sine, cosine), start = std::atan2(sine, cosine);
    const double mean = start - sine + turn / std::pow(a, 1.5);
    double anomaly = mean;
    for (int k = 0; k < 50; ++k) anomaly = mean + e * std::sin(anomaly);
    // Positions are along the axes of perigee; the rotation below turns them into those of the
    // start.
    const auto position = [&](double angle) {
      return Eigen::Vector2d(a * (std::cos(angle) - e), a * std::sqrt(1 - e * e) * std::sin(angle));
    };
    const Eigen::Vector2d first = position(start), last = position(anomaly);
    const double turned = std::atan2(y, 1) - std::atan2(first.y(), first.x());
    return (Eigen::Rotation2Dd(turned) * last - Eigen::Vector2d(1, 0)).norm();
  }
  /// The places at which the distance is the radius, on one side of the origin.
  static double bound(double radius, double side) {
    double low = 0, high = side;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (distance(middle) < radius ? low : high) = middle;
    }
    return low;
  }
  /// Deviations of size s about a mean; the window is the end of the turn alone, in which nothing
  /// moves by more than its length.
  static EncounterProblem problem(double mean, double s, double radius) {
    EncounterProblem result{kepler(), {}, ClockTime::epoch()};
    result.spacecraft[0].state = {1, 0, 0, 0, 1, 0};
    result.spacecraft[1].state = {1, mean, 0, 0, 1, 0};
    result.spacecraft[1].factor(1, 1) = s;
    result.from = 2 * std::numbers::pi - 1e-7;
    result.to = 2 * std::numbers::pi;
    result.radius = radius;
    result.order = 1;
    result.settings.tolerance = 1e-12;
    return result;
  }
};

TEST(CollisionIntervals, IntervalsHoldWhatThePolynomialsLeaveOut) {
  constexpr double mean = 0.005, s = 0.01, radius = 0.008;
  const auto below = [&](double y) { return std::erfc(-(y - mean) / s / std::sqrt(2.0)) / 2; };
  const double expected =
      below(LateDeputy::bound(radius, 1)) - below(LateDeputy::bound(radius, -1));
  const CollisionProbability result =
      collision_probability(LateDeputy::problem(mean, s, radius), samples(100'000));
  // Four of the interval's own standard errors do not reach the value.
  EXPECT_GT(std::abs(result.probability - expected), 4 * result.standard_error);
  EXPECT_LT(result.lower, expected);
  EXPECT_GT(result.upper, expected);
  EXPECT_GT(result.path_error, 1e-4);
  EXPECT_LT(result.path_error, 2e-3);
}

// Of the formula of RelativeOrbit, with an offset that is normal: paths that come to be nearer than
// the radius after they were not.
TEST(CollisionIntervals, OfEntryCountsWhatComesBack) {
  constexpr double e = 1e-6, s = 1e-6, radius = 1.6e-6;
  EncounterProblem problem = test::RelativeOrbit{e, e, 0, 0}.problem(7, 2);
  problem.radius = radius;
  problem.spacecraft[1].factor.col(0) = test::RelativeOrbit::along_the_orbit(s);
  double expected = 0, of_begin_outside = 0;
  constexpr int parts = 1000, looks = 700;
  for (int k = 0; k < parts; ++k) {
    const double x = -8 + 16 * (k + 0.5) / parts;
    bool was_outside = false, enters = false, begins_outside = false;
    for (int i = 0; i <= looks; ++i) {
      const double t = 7.0 * i / looks;
      const bool is_outside = std::hypot(e, s * x + 2 * e * std::sin(t)) >= radius;
      if (i == 0) begins_outside = is_outside;
      enters = enters || (was_outside && !is_outside);
      was_outside = was_outside || is_outside;
    }
    const double share = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi) * 16 / parts;
    if (enters) expected += share;
    if (enters && begins_outside) of_begin_outside += share;
  }
  CollisionSettings of_entry = samples(40'000);
  of_entry.event = CollisionEvent::entry;
  const CollisionProbability result = collision_probability(problem, of_entry);
  EXPECT_GT(expected - of_begin_outside, 0.1);
  EXPECT_NEAR(result.probability, expected, 4 * result.standard_error + 1e-3);
}

}  // namespace
}  // namespace hamjet
