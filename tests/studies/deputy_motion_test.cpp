#include "studies/formation/deputy_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/error.hpp"
#include "studies/exact_flow.hpp"

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
  ASSERT_EQ((motion.flown.states.size() - 1) % (motion.points.size() - 1), 0U);
  EXPECT_EQ(motion.points.front().time, 0);
  EXPECT_DOUBLE_EQ(motion.points.back().time, 2 * std::numbers::pi);
  for (std::size_t i = 0; i < motion.points.size(); ++i) {
    EXPECT_LT((motion.points[i].state.position_m - start.position_m).norm(), 1e-6);
  }
  EXPECT_LT(motion.largest_error_m(4), 1e-4);
  // The straight line of the linear theory leaves the circle by about R angle^2.
  EXPECT_GT(motion.largest_error_m(1), 0.1 * radius_m * angle * angle);
}

// A path that is drawn with fewer points in each revolution has corners.
TEST(DeputyMotion, APathOfManyRevolutionsIsSmooth) {
  RelativeState start;
  const double angle = 1e-4;
  start.position_m = length_km * 1000 * Eigen::Vector3d(std::cos(angle) - 1, -std::sin(angle), 0);
  Scene scene = circle(1, start);
  constexpr int revolutions = 40;
  scene.duration *= revolutions;
  const DeputyMotion motion = study_deputy_motion(scene);
  EXPECT_GE(motion.flown.states.size(), 64U * revolutions);
  EXPECT_LE(motion.points.size(), 1025U);
  EXPECT_DOUBLE_EQ(motion.points.back().time, motion.flown.times.back());
  const auto& times = motion.flown.times;
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  for (const RelativeState& state : motion.flown.states) {
    EXPECT_LT((state.position_m - start.position_m).norm(), 1e-3);
  }
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

// On a circle of the chief's radius, tilted by i and ahead by a, a deputy is at the angle s from
// its chief, cos s = cos a - sin u sin(u + a) (1 - cos i) with the chief's angle u from the node.
// It is nearest at u = -a/2, and farthest a quarter turn later, far from the times that are listed.
TEST(DeputyMotion, TheExtremesAreFoundBetweenTheTimes) {
  const double i = 1e-3, a = 1e-6, u0 = 0.34, speed_m_s = std::sqrt(398600.4415 / length_km) * 1000;
  const auto chief = [&](double u) {
    return Eigen::Vector3d(std::cos(u), std::sin(u) * std::cos(i), std::sin(u) * std::sin(i));
  };
  const double quarter = std::numbers::pi / 2;
  Scene scene = circle(2, {});
  const Eigen::Vector3d q = chief(u0), p = chief(u0 + quarter);
  for (int k = 0; k < 3; ++k) {
    scene.nominal[static_cast<std::size_t>(k)] = q[k];
    scene.nominal[static_cast<std::size_t>(k) + 3] = p[k];
  }
  const auto deputy = [&](double u) { return Eigen::Vector3d(std::cos(u), std::sin(u), 0); };
  scene.deputy->frame = RelativeFrame::inertial;
  scene.deputy->start.position_m = length_km * 1000 * (deputy(u0 + a) - q);
  scene.deputy->start.velocity_m_s = speed_m_s * (deputy(u0 + a + quarter) - p);
  const DeputyMotion motion = study_deputy_motion(scene);
  const auto separation_m = [&](double u) {
    return length_km * 1000 * (deputy(u + a) - chief(u)).norm();
  };
  const auto& [nearest, farthest] = motion.extremes;
  const double half_turn = std::numbers::pi;
  EXPECT_NEAR(std::remainder(u0 + nearest.time + a / 2, half_turn), 0, 1e-6);
  EXPECT_NEAR(std::remainder(u0 + farthest.time + a / 2 - quarter, half_turn), 0, 1e-6);
  EXPECT_NEAR(nearest.state.position_m.norm(), separation_m(-a / 2), 1e-5);
  EXPECT_NEAR(farthest.state.position_m.norm(), separation_m(quarter - a / 2), 1e-5);
  // 7 m, although the nearest of the listed times is hundreds of metres away.
  double listed = 1e9;
  for (std::size_t k = 0; k < motion.points.size(); ++k) {
    listed = std::min(listed, hamjet::separation_m(motion.points[k].state));
  }
  EXPECT_GT(listed, 10 * nearest.state.position_m.norm());
}

// The flight to each time starts where the one before ended, and rounds its start. Over fifteen
// revolutions these flights therefore end elsewhere than a single flight, but by no more than the
// floor says.
TEST(DeputyMotion, TheFloorCountsTheFlights) {
  RelativeState start;
  start.position_m = {0, -1000, 0};
  Scene scene = circle(1, start);
  scene.duration = 30 * std::numbers::pi;
  const DeputyMotion motion = study_deputy_motion(scene);
  const std::vector<double> once =
      exact_flow(make_system(scene), motion.flown.deputy.front(), scene.start_time, scene.duration);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    square += std::pow(once[i] - motion.flown.deputy.back()[i], 2);
  }
  const double gap_m = std::sqrt(square) * length_km * 1000;
  EXPECT_LT(gap_m, motion.flight_floor_m);
  EXPECT_GT(gap_m, motion.flight_floor_m / 1000);
  EXPECT_EQ(motion.flight_floor_m, motion.points.back().flight_floor_m);
  for (std::size_t i = 1; i < motion.points.size(); ++i) {
    EXPECT_GT(motion.points[i].flight_floor_m, 0);
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
