#include "uncertainty/cut_passage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/collision_probability.hpp"
#include "relative_orbits.hpp"

namespace hamjet {
namespace {

/// Two on circles that cross at right angles at (1, 0, 0), where both are so long after the epoch,
/// the second farther from the centre by a miss.
EncounterProblem crossing(double after, double miss) {
  constexpr double s = 1e-6;
  const double c = std::cos(after), d = std::sin(after);
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.spacecraft[0].state = {c, -d, 0, d, c, 0};
  problem.spacecraft[1].state = {c * (1 + miss), 0, -d * (1 + miss), d, 0, c};
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor.topLeftCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
    craft.factor.bottomRightCorner<3, 3>() = 0.3 * s * Eigen::Matrix3d::Identity();
  }
  problem.to = 0.01;
  problem.radius = s / 2;
  problem.order = 2;
  problem.settings.tolerance = 1e-13;
  return problem;
}

// At the square root of 2 of the orbital speed, a radius and nine standard deviations of the root
// of 2 of s along it take (0.5 + 9 sqrt(2)) / sqrt(2) of s.
TEST(CutPassage, IsWholeToBothSides) {
  constexpr double s = 1e-6;
  const double half = (0.5 / std::sqrt(2.0) + 9) * s;
  for (const double after : {0.0, 3e-6, -3e-6}) {
    const auto whole = with_whole_passages(crossing(after, s));
    ASSERT_TRUE(whole) << after;
    EXPECT_NEAR(whole->from, after - half, 1e-3 * half) << after;
    EXPECT_EQ(whole->to, 0.01) << after;
  }
  EncounterProblem ends = crossing(0.01, s);
  const auto whole = with_whole_passages(ends);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->from, 0);
  EXPECT_NEAR(whole->to, 0.01 + half, 1e-3 * half);
}

// From the moment of the closest approach on, a window has half of the passage; the whole has what
// the integral over the disc across the velocity has.
TEST(CutPassage, HasTheProbabilityOfAShortEncounter) {
  const EncounterProblem cut = crossing(0, 1e-6);
  const auto whole = with_whole_passages(cut);
  ASSERT_TRUE(whole);
  const auto approaches = closest_approaches(*whole);
  ASSERT_EQ(approaches.size(), 1U);
  EXPECT_NEAR(approaches[0].time, 0, 1e-9);
  const ShortEncounter plane = short_encounter(*whole, approaches[0].time);
  EXPECT_TRUE(plane.holds());
  CollisionSettings settings;
  settings.samples = 4000;
  const CollisionProbability of_whole = collision_probability(*whole, settings);
  EXPECT_NEAR(of_whole.probability, plane.alfano,
              4 * of_whole.standard_error + 1e-3 * plane.alfano);
  EXPECT_LT(collision_probability(cut, settings).probability, 0.8 * plane.alfano);
}

TEST(CutPassage, IsNoneWhereNothingPasses) {
  constexpr double s = 1e-6;
  // There is no passage before or after it, beside it, or for spacecraft that keep company.
  EXPECT_FALSE(with_whole_passages(crossing(1e-3, s)));
  EXPECT_FALSE(with_whole_passages(crossing(-1e-3, s)));
  EXPECT_FALSE(with_whole_passages(crossing(0, 1e-3)));
  EncounterProblem company = test::RelativeOrbit{s, s, 0, 0}.problem(1, 2);
  company.radius = s;
  company.spacecraft[1].factor.diagonal().setConstant(s);
  EXPECT_FALSE(with_whole_passages(company));
}

}  // namespace
}  // namespace hamjet
