#include "studies/formation/deputy_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double length_km = 7000;

/// A circle of Kepler's problem over a revolution.
Scene circle(int order, const RelativeState& start) {
  Scene scene = kepler_chief(0, length_km, std::sqrt(std::pow(length_km, 3) / 398600.4415), order);
  scene.duration = 2 * std::numbers::pi;
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, start};
  return scene;
}

// On the chief's own circle a deputy rests as seen from the turning axes.
TEST(DeputyMotion, ADeputyOnTheChiefsCircleStaysWhereItIs) {
  const double angle = 1e-4;
  const double radius_m = length_km * 1000;
  RelativeState start;
  start.position_m = radius_m * Eigen::Vector3d(std::cos(angle) - 1, std::sin(angle), 0);
  const DeputyMotion motion = study_deputy_motion(circle(4, start));
  ASSERT_GE(motion.points.size(), 65U);
  ASSERT_EQ(motion.points.size(), motion.flown.states.size());
  EXPECT_EQ(motion.points.front().time, 0);
  EXPECT_DOUBLE_EQ(motion.points.back().time, 2 * std::numbers::pi);
  for (std::size_t i = 0; i < motion.points.size(); ++i) {
    EXPECT_LT((motion.points[i].state.position_m - start.position_m).norm(), 1e-4);
    EXPECT_LT((motion.flown.states[i].position_m - start.position_m).norm(), 1e-6);
  }
  EXPECT_LT(motion.largest_error_m(4), 1e-4);
  // The line in which the linear theory has it leaves the circle by some R angle^2.
  EXPECT_GT(motion.largest_error_m(1), 0.1 * radius_m * angle * angle);
}

// The first term that order n leaves out is of degree n + 1.
TEST(DeputyMotion, ErrorsGrowWithTheSeparationAsTheNextDegree) {
  RelativeState start;
  start.position_m = {1000, -4000, 2000};
  const DeputyMotion motion = study_deputy_motion(circle(3, start));
  start.position_m /= 2;
  const DeputyMotion half = study_deputy_motion(circle(3, start));
  for (int order = 1; order <= 2; ++order) {
    EXPECT_NEAR(motion.largest_error_m(order) / half.largest_error_m(order), std::pow(2, order + 1),
                0.02 * std::pow(2, order + 1))
        << order;
  }
}

TEST(DeputyMotion, NeedsADeputyAndATime) {
  Scene scene = circle(2, {});
  scene.duration = 0;
  EXPECT_THROW(study_deputy_motion(scene), Error);
  scene = circle(2, {});
  scene.deputy.reset();
  EXPECT_THROW(study_deputy_motion(scene), Error);
}

}  // namespace
}  // namespace hamjet
