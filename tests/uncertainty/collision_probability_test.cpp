#include "hamjet/uncertainty/collision_probability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "hamjet/error.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/least_separations.hpp"
#include "relative_orbits.hpp"
#include "uncertainty/published_encounters.hpp"

// Probabilities of collision against published samples, closed forms, and plain samples, which
// share with weighted ones the polynomials but not the distribution.

namespace hamjet {
namespace {

CollisionSettings settings(long samples,
                           CollisionSampling sampling = CollisionSampling::automatic) {
  CollisionSettings s;
  s.samples = samples;
  s.sampling = sampling;
  s.threads = 2;
  return s;
}

/// Whether two estimates agree within four standard errors of their difference, which one in 16000
/// pairs exceeds.
void expect_agreement(double a, double error_a, double b, double error_b, const std::string& what) {
  EXPECT_LE(std::abs(a - b), 4 * std::hypot(error_a, error_b))
      << what << ": " << a << " +- " << error_a << ", " << b << " +- " << error_b;
}

TEST(CollisionProbability, AgreesWithPublishedSamplesOfSlowEncounters) {
  // Published are probabilities of entering the sphere within the window, from 1e8 samples: those
  // that begin inside (0.084 in case 9, 0.0019 in case 12) are not among them.
  for (const test::PublishedEncounter& e : test::published_encounters()) {
    CollisionSettings s = settings(30'000);
    s.event = CollisionEvent::entry;
    const CollisionProbability result = collision_probability(e.problem, s);
    const std::string name = "case " + std::to_string(e.number);
    EXPECT_EQ(result.sampling, CollisionSampling::entries) << name;
    EXPECT_TRUE(result.lower <= e.upper && result.upper >= e.lower)
        << name << ": " << result.lower << " to " << result.upper << ", published " << e.lower
        << " to " << e.upper;
    expect_agreement(result.probability, result.standard_error, e.probability,
                     (e.upper - e.lower) / (2 * 1.96), name);
    // A weighted sample tells more than a plain one by far.
    EXPECT_GT(result.equivalent_samples, 20 * static_cast<double>(result.samples)) << name;
    EXPECT_LE(std::abs(result.change_from_lower_order),
              0.01 * result.probability + 4 * result.standard_error_of_change)
        << name;
  }
}

TEST(CollisionProbability, WeightedAndPlainSamplesAgree) {
  for (const test::PublishedEncounter& e : test::published_encounters()) {
    if (e.number != 2 && e.number != 9) continue;
    for (const CollisionEvent event : {CollisionEvent::nearer, CollisionEvent::entry}) {
      CollisionSettings s = settings(30'000, CollisionSampling::plain);
      s.event = event;
      const CollisionProbability plain = collision_probability(e.problem, s);
      s.sampling = CollisionSampling::entries;
      const CollisionProbability weighted = collision_probability(e.problem, s);
      expect_agreement(plain.probability, plain.standard_error, weighted.probability,
                       weighted.standard_error, "case " + std::to_string(e.number));
      EXPECT_NEAR(plain.by_time.back(), plain.probability, 1e-12);
      EXPECT_TRUE(std::is_sorted(weighted.by_time.begin(), weighted.by_time.end()));
    }
  }
}

TEST(CollisionProbability, OfAnInstantIsThatOfANormalVectorInABall) {
  // In a window too short for any motion, of independent deviations of one size s: the squared
  // distance over 2 s^2 is of the non-central chi-squared distribution of three degrees of freedom.
  for (const double offset : {0.5, 3.0, 8.0}) {
    EncounterProblem problem;
    problem.system = kepler();
    const double s = 1e-6;
    for (UncertainSpacecraft& craft : problem.spacecraft) {
      craft.state = {1, 0, 0, 0, 1, 0};
      craft.factor.topLeftCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
      craft.factor.bottomRightCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
    }
    problem.spacecraft[1].state[1] += offset * s;
    problem.to = 1e-9;
    problem.radius = 1.5 * s;
    problem.order = 2;
    problem.settings.tolerance = 1e-12;
    const boost::math::non_central_chi_squared distance(3.0, offset * offset / 2);
    const double expected = boost::math::cdf(distance, 1.5 * 1.5 / 2);
    const CollisionProbability result = collision_probability(problem, settings(40'000));
    EXPECT_LE(std::abs(result.probability - expected), 4 * result.standard_error + 1e-6 * expected)
        << offset << ": " << result.probability << ", " << expected;
    EXPECT_LT(result.standard_error, 0.01 * expected);
  }
}

TEST(CollisionProbability, OfFastEncountersIsThatOfThePlaneDownToRareOnes) {
  // Two circular orbits that cross at right angles: at 1.4 orbital speeds motion is straight while
  // they are near, and the integral over the disc across the velocity is exact. Its curvature
  // within the passage is 1e-6 of the deviations.
  for (const double miss : {0.0, 4.0, 8.0, 11.5}) {
    EncounterProblem problem;
    problem.system = kepler();
    const double s = 1e-6, duration = 1;
    // Both arrive at (1, 0, 0), the second with an offset along x; the starts are a radian before.
    const double c = std::cos(duration), d = std::sin(duration);
    problem.spacecraft[0].state = {c, -d, 0, d, c, 0};
    problem.spacecraft[1].state = {c * (1 + miss * s), 0, -d * (1 + miss * s), d, 0, c};
    for (UncertainSpacecraft& craft : problem.spacecraft) {
      craft.factor.topLeftCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
      craft.factor.bottomRightCorner<3, 3>() = 0.3 * s * Eigen::Matrix3d::Identity();
    }
    problem.from = duration - 1e-4;
    problem.to = duration + 1e-4;
    problem.radius = s / 2;
    problem.order = 2;
    problem.settings.tolerance = 1e-13;
    const auto approaches = closest_approaches(problem);
    ASSERT_EQ(approaches.size(), 1U);
    const ShortEncounter plane = short_encounter(problem, approaches[0].time);
    EXPECT_TRUE(plane.holds()) << plane.departure;
    const CollisionProbability result = collision_probability(problem, settings(40'000));
    EXPECT_LE(std::abs(result.probability - plane.alfano),
              4 * result.standard_error + 1e-3 * plane.alfano)
        << miss << ": " << result.probability << ", " << plane.alfano;
    EXPECT_LT(result.standard_error, 0.02 * plane.alfano);
    EXPECT_NEAR(plane.foster / plane.alfano, 1, 1e-9);
  }
}

/// Two spacecraft on one orbit with exact velocities, independent deviations in position of one
/// size, which is the radius too, and so many of them apart along the orbit.
EncounterProblem exact_velocities(double apart, double duration) {
  EncounterProblem problem;
  problem.system = kepler();
  const double s = 1e-6;
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.state = {1, 0, 0, 0, 1, 0.1};
    craft.factor.topLeftCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
  }
  problem.spacecraft[1].state[1] += apart * s;
  problem.to = duration;
  problem.radius = s;
  problem.order = 2;
  problem.settings.tolerance = 1e-12;
  return problem;
}

TEST(CollisionProbability, OfExactVelocitiesIsThatOfPlainSamples) {
  // Positions tell the velocities then, and the speed of entry follows from where a path enters.
  const EncounterProblem problem = exact_velocities(3, 1);
  const CollisionProbability plain =
      collision_probability(problem, settings(50'000, CollisionSampling::plain));
  const CollisionProbability weighted =
      collision_probability(problem, settings(20'000, CollisionSampling::entries));
  ASSERT_GT(plain.hits, 100);
  expect_agreement(plain.probability, plain.standard_error, weighted.probability,
                   weighted.standard_error, "exact velocities");
}

TEST(CollisionProbability, DoesNotBelieveTheWeightsOfAFewDraws) {
  // With exact velocities nearly half a revolution leads most entries to where no start can be: a
  // few draws have all of the weight.
  const EncounterProblem problem = exact_velocities(4, 3);
  const CollisionProbability result = collision_probability(problem, settings(20'000));
  EXPECT_EQ(result.sampling, CollisionSampling::plain);
  // From 14 million samples of the linear motion of two bodies, whose matrices are differences of
  // orbits flown by the method of Dormand and Prince: 0.0738 with a standard error of 7e-5.
  expect_agreement(result.probability, result.standard_error, 0.0738, 7e-5, "few draws");
  try {
    collision_probability(problem, settings(20'000, CollisionSampling::entries));
    ADD_FAILURE() << "entries were believed";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("a few of the drawn entries"), std::string::npos);
  }
}

TEST(CollisionProbability, OfBeginningInsideIsWhatEntriesLeaveOut) {
  // To be nearer is to begin so, or to become so: what the two events differ by is the probability
  // that a normal vector of independent components is in a ball. The orbits bend so much that the
  // sampled sphere is wider than the radius by a part of a hundred, and paths that begin between
  // the two spheres are half of a hundredth of that probability.
  EncounterProblem problem;
  problem.system = kepler();
  const double s = 1e-3;
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.state = {1, 0, 0, 0, 1, 0};
    craft.factor.topLeftCorner<3, 3>() = s / std::sqrt(2.0) * Eigen::Matrix3d::Identity();
    craft.factor.bottomRightCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
  }
  problem.to = 1;
  problem.radius = s;
  problem.order = 3;
  problem.settings.tolerance = 1e-12;
  CollisionSettings s_of = settings(60'000, CollisionSampling::entries);
  const CollisionProbability nearer = collision_probability(problem, s_of);
  s_of.event = CollisionEvent::entry;
  const CollisionProbability entry = collision_probability(problem, s_of);
  const double begin = boost::math::cdf(boost::math::chi_squared(3.0), 1.0);
  const double error = std::hypot(nearer.standard_error, entry.standard_error);
  EXPECT_NEAR(nearer.probability - entry.probability, begin, 4 * error);
  EXPECT_GT(*entry.sampled_radius, 1.002 * problem.radius);
  // Without the shell the difference would be larger by half of its probability.
  const double wide = std::pow(*entry.sampled_radius / problem.radius, 2);
  const double shell = boost::math::cdf(boost::math::chi_squared(3.0), wide) - begin;
  EXPECT_GT(shell / 2, 6 * error);
}

// A relative ellipse that passes through the chief itself three quarters of a turn after the start,
// across a normal component of deviation s sin t: its least distance is |s| there, to the part 1e-6
// of second order. The window of whole and half turns has nodes at which the motion repeats.
TEST(CollisionProbability, SeesEncountersInWindowsOfWholeTurns) {
  constexpr double e = 1e-6, s = 5e-9, pi = std::numbers::pi;
  const double expected = std::erf(2 / std::sqrt(2.0));
  for (const double window : {2 * pi, 4 * pi, 5 * pi, 8 * pi}) {
    EncounterProblem problem = test::RelativeOrbit{e, 0, 0, 2 * e}.problem(window, 2);
    problem.radius = 2 * s;
    problem.spacecraft[1].factor(5, 5) = s;
    const CollisionProbability result = collision_probability(problem, settings(10'000));
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
  /// How far from the chief it is at the end of a turn.
  static double distance(double y) {
    const double r = std::hypot(1, y), a = 1 / (2 / r - 1), turn = 2 * std::numbers::pi;
    // r.v = y, and e sin E = r.v / sqrt(a), e cos E = 1 - r/a.
    const double sine = y / std::sqrt(a), cosine = 1 - r / a;
    const double e = std::hypot(sine, cosine), start = std::atan2(sine, cosine);
    const double mean = start - sine + turn / std::pow(a, 1.5);
    double anomaly = mean;
    for (int k = 0; k < 50; ++k) anomaly = mean + e * std::sin(anomaly);
    // Along axes of perigee, from those of the start.
    const auto position = [&](double angle) {
      return Eigen::Vector2d(a * (std::cos(angle) - e), a * std::sqrt(1 - e * e) * std::sin(angle));
    };
    const Eigen::Vector2d first = position(start), last = position(anomaly);
    const double turned = std::atan2(y, 1) - std::atan2(first.y(), first.x());
    return (Eigen::Rotation2Dd(turned) * last - Eigen::Vector2d(1, 0)).norm();
  }
  /// Where the distance is the radius, on one side of the origin.
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
    EncounterProblem result;
    result.system = kepler();
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

TEST(CollisionProbability, IntervalsHoldWhatThePolynomialsLeaveOut) {
  constexpr double mean = 0.005, s = 0.01, radius = 0.008;
  const auto below = [&](double y) { return std::erfc(-(y - mean) / s / std::sqrt(2.0)) / 2; };
  const double expected =
      below(LateDeputy::bound(radius, 1)) - below(LateDeputy::bound(radius, -1));
  const CollisionProbability result =
      collision_probability(LateDeputy::problem(mean, s, radius), settings(100'000));
  // Four of its own standard errors do not reach it.
  EXPECT_GT(std::abs(result.probability - expected), 4 * result.standard_error);
  EXPECT_LT(result.lower, expected);
  EXPECT_GT(result.upper, expected);
  EXPECT_GT(result.path_error, 1e-4);
  EXPECT_LT(result.path_error, 2e-3);
}

// Of the formula of RelativeOrbit, with an offset that is normal: paths that come to be nearer than
// the radius after they were not.
TEST(CollisionProbability, OfEntryCountsWhatComesBack) {
  constexpr double e = 1e-6, s = 1e-6, radius = 1.6e-6;
  EncounterProblem problem = test::RelativeOrbit{e, e, 0, 0}.problem(7, 2);
  problem.radius = radius;
  problem.spacecraft[1].factor.col(0) = test::RelativeOrbit::along_the_orbit(s);
  double expected = 0, of_begin_outside = 0;
  constexpr int parts = 4000, looks = 2000;
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
  CollisionSettings of_entry = settings(40'000);
  of_entry.event = CollisionEvent::entry;
  const CollisionProbability result = collision_probability(problem, of_entry);
  EXPECT_GT(expected - of_begin_outside, 0.1);
  EXPECT_NEAR(result.probability, expected, 4 * result.standard_error + 1e-3);
}

TEST(CollisionProbability, TakesTheLeastConfidenceThatScenesMayHave) {
  CollisionSettings even = settings(2000);
  even.confidence = 0.5;
  const CollisionProbability result =
      collision_probability(test::published_encounters()[0].problem, even);
  EXPECT_LT(result.lower, result.probability);
  EXPECT_GT(result.upper, result.probability);
}

TEST(CollisionProbability, TakesAsManySamplesAsAreAskedFor) {
  const EncounterProblem problem = test::published_encounters()[0].problem;
  for (const long samples : {1000L, 4095L, 4097L}) {
    for (const auto sampling : {CollisionSampling::plain, CollisionSampling::entries}) {
      EXPECT_EQ(collision_probability(problem, settings(samples, sampling)).samples, samples);
    }
    EXPECT_EQ(least_separations(problem, settings(samples), {0.5}).samples, samples);
  }
}

TEST(CollisionProbability, DoesNotDependOnThreads) {
  const auto encounters = test::published_encounters();
  CollisionSettings s = settings(20'000);
  s.threads = 1;
  const CollisionProbability one = collision_probability(encounters[3].problem, s);
  s.threads = 3;
  const CollisionProbability three = collision_probability(encounters[3].problem, s);
  EXPECT_EQ(one.probability, three.probability);
  EXPECT_EQ(one.standard_error, three.standard_error);
  s.seed = 2;
  const CollisionProbability other = collision_probability(encounters[3].problem, s);
  EXPECT_NE(one.probability, other.probability);
  expect_agreement(one.probability, one.standard_error, other.probability, other.standard_error,
                   "another seed");
}

TEST(CollisionProbability, OfWhatIsFarIsNone) {
  EncounterProblem problem = test::published_encounters()[0].problem;
  problem.spacecraft[1].state[2] += 0.01;
  problem.to = problem.from + 1e-3;
  const CollisionProbability result = collision_probability(problem, settings(1000));
  EXPECT_EQ(result.probability, 0);
  EXPECT_EQ(result.samples, 0);
}

TEST(CollisionProbability, WithoutUncertaintyInSomeDirectionIsBySamples) {
  EncounterProblem problem = test::published_encounters()[0].problem;
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor.row(2).setZero();
    craft.factor.row(5).setZero();
  }
  EXPECT_EQ(collision_probability(problem, settings(5000)).sampling, CollisionSampling::plain);
  EXPECT_THROW(collision_probability(problem, settings(5000, CollisionSampling::entries)), Error);
}

TEST(LeastSeparations, HaveTheShareOfCollisionsBelowTheRadius) {
  // The radius is the quantile of the least separation at the probability of coming nearer.
  const test::PublishedEncounter e = test::published_encounters()[0];
  CollisionSettings s = settings(20'000, CollisionSampling::plain);
  const CollisionProbability collision = collision_probability(e.problem, s);
  const double p = collision.probability;
  const double error = 4 * std::sqrt(2 * p * (1 - p) / 20'000);
  const LeastSeparations least = least_separations(e.problem, s, {p - error, p + error});
  EXPECT_LT(least.separations[0], e.problem.radius);
  EXPECT_GT(least.separations[1], e.problem.radius);
  EXPECT_THROW(least_separations(e.problem, s, {1.0}), Error);
}

TEST(CollisionProbability, RefusesWhatIsNoProblem) {
  EncounterProblem problem = test::published_encounters()[0].problem;
  EXPECT_THROW(collision_probability(problem, settings(10)), Error);
  CollisionSettings s = settings(1000);
  s.confidence = 1;
  EXPECT_THROW(collision_probability(problem, s), Error);
  problem.radius = 0;
  EXPECT_THROW(collision_probability(problem, settings(1000)), Error);
  problem.radius = 1e-6;
  problem.to = problem.from;
  EXPECT_THROW(collision_probability(problem, settings(1000)), Error);
}

}  // namespace
}  // namespace hamjet
