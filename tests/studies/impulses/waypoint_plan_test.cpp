#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "circle_transfers.hpp"

// Transfers through waypoints. Expected: the equations of Clohessy and Wiltshire metres from a
// circle, and identities of the flight.

namespace hamjet {
namespace {

/// A transfer metres from a circle of mean motion 1 through places at times.
Scene through(const std::vector<Waypoint>& waypoints, const RelativeState& start,
              std::vector<double> times) {
  Scene scene = metres_from_circle(start, times.back());
  scene.transfer->impulses = TransferImpulses::two;
  scene.transfer->times = std::move(times);
  scene.transfer->waypoints = waypoints;
  return scene;
}

/// The velocity changes of the linear theory; a metre changes them by less than 1e-6.
std::vector<Eigen::Vector3d> expected_changes(const Scene& scene) {
  const TransferSettings& settings = *scene.transfer;
  std::vector<Waypoint> places = settings.waypoints;
  places.push_back({settings.times.back(), settings.end.position_m});
  Vector6 state;
  state << settings.start.position_m, settings.start.velocity_m_s * scene.units.time_s;
  std::vector<Eigen::Vector3d> changes;
  double now = 0;
  for (const Waypoint& place : places) {
    const Eigen::Matrix<double, 6, 6> flow = clohessy_wiltshire(place.time - now);
    const Eigen::Vector3d rest = place.position_m - flow.topLeftCorner<3, 3>() * state.head<3>();
    const Eigen::Vector3d velocity = flow.topRightCorner<3, 3>().inverse() * rest;
    changes.push_back(velocity - state.tail<3>());
    state.tail<3>() = velocity;
    state = flow * state;
    now = place.time;
  }
  changes.push_back(settings.end.velocity_m_s * scene.units.time_s - state.tail<3>());
  return changes;
}

TEST(WaypointPlan, IsThatOfTheLinearTheoryNearACircle) {
  const Scene scene =
      through({{1.1, {2, -3, 1}}, {2.9, {-1, -4, -1}}}, {{0, 5, 1}, {1, 0, -1}}, {2.5, 4.2, 5.3});
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.waypoints.has_value());
  EXPECT_EQ(result.waypoints->failure, "");
  EXPECT_EQ(exit_code(result), 0);
  // The first of the times is before the last waypoint.
  ASSERT_EQ(result.waypoints->plans.size(), 2U);
  EXPECT_EQ(result.waypoints->plans[0].duration, 4.2);
  const WaypointPlan& plan = result.waypoints->plans[1];
  const std::vector<Eigen::Vector3d> expected = expected_changes(scene);
  ASSERT_EQ(plan.impulses.size(), expected.size());
  double total = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Eigen::Vector3d change = plan.impulses[k].change_m_s * scene.units.time_s;
    EXPECT_LT((change - expected[k]).norm(), 1e-5 * expected[k].norm()) << k;
    total += change.norm();
  }
  EXPECT_NEAR(plan.total_change_m_s() * scene.units.time_s, total, 1e-12 * total);
  for (const WaypointLeg& leg : plan.legs) EXPECT_LE(leg.miss_m, scene.transfer->refined_miss_m);
  const std::size_t best = *result.waypoints->best_plan;
  EXPECT_EQ(best,
            result.waypoints->plans[0].total_change_m_s() < plan.total_change_m_s() ? 0U : 1U);
}

// A waypoint that the transfer of two impulses passes needs no impulse.
TEST(WaypointPlan, OnTheWayAsksForNothing) {
  Scene scene = paper_chief(4);
  TransferSettings settings;
  settings.start.position_m = {2000, -9000, 3000};
  settings.end.position_m = {0, -500, 200};
  settings.times = {0.7 * paper_period};
  settings.refine = true;
  settings.refined_miss_m = 1e-5;
  scene.transfer = settings;
  const TransferResult direct = study_transfer(scene);
  const RelativeTrajectory way =
      fly_relative(direct, 0, equal_times_from_0(direct.points[0].time, 8));
  ASSERT_EQ(way.frame, settings.frame);
  scene.transfer->waypoints = {{way.times[3], way.states[3].position_m},
                               {way.times[5], way.states[5].position_m}};
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.waypoints && result.waypoints->best_plan) << result.waypoints->failure;
  const WaypointPlan& plan = result.waypoints->plans[0];
  ASSERT_EQ(plan.impulses.size(), 4U);
  // A miss of 1e-5 m in an eighth of a revolution, and the rounding of the flights.
  EXPECT_LT(plan.impulses[1].change_m_s.norm(), 1e-6);
  EXPECT_LT(plan.impulses[2].change_m_s.norm(), 1e-6);
  EXPECT_NEAR(plan.total_change_m_s(), direct.points[0].change_m_s(), 3e-6);
  EXPECT_GT(plan.legs[0].flights, 1);
}

// Out of the plane the primer vector is a harmonic oscillation of the orbit's period, which two
// impulses fix: p(t) = (p0 sin(b - t) + p1 sin(t - a)) / sin(b - a).
TEST(WaypointPlan, PrimerVectorsOfItsLegsInClosedForm) {
  const Scene scene = through({{2, {0, 0, 1}}}, {{0, 0, 1}, {0, 0, 0.2}}, {4.5});
  const TransferResult result = study_transfer(scene);
  const WaypointPlan& plan = result.waypoints->plans.at(0);
  const std::vector<Eigen::Vector3d> expected = expected_changes(scene);
  for (std::size_t k = 0; k < 2; ++k) {
    const WaypointLeg& leg = plan.legs[k];
    const double first = expected[k][2] > 0 ? 1 : -1, last = expected[k + 1][2] > 0 ? 1 : -1;
    double largest = 0;
    for (int i = 0; i <= 100000; ++i) {
      const double t = leg.start + (leg.end - leg.start) * i / 100000;
      largest = std::max(largest,
                         std::abs((first * std::sin(leg.end - t) + last * std::sin(t - leg.start)) /
                                  std::sin(leg.end - leg.start)));
    }
    ASSERT_TRUE(leg.primer.has_value());
    // The grid has 48 times a revolution, and impulses are out of the plane to 1e-6.
    EXPECT_LE(leg.primer->magnitude, largest * (1 + 1e-5)) << k;
    EXPECT_GT(leg.primer->magnitude, largest * (1 - 3e-3)) << k;
  }
}

TEST(WaypointPlan, ThatIsForbiddenOrNotThereIsSaid) {
  Scene scene = through({{1.1, {2, -3, 1}}}, {{0, 5, 1}, {1, 0, -1}}, {2.5});
  scene.transfer->largest_impulse_m_s = 1e-6;
  TransferResult result = study_transfer(scene);
  EXPECT_FALSE(result.waypoints->best_plan.has_value());
  EXPECT_NE(result.waypoints->failure.find("above largest_impulse_m_s"), std::string::npos);
  EXPECT_EQ(exit_code(result), 1);
  // After half a revolution what is out of the plane is on the other side, whatever the velocity.
  scene = through({{std::numbers::pi, {2, -3, 1}}}, {{0, 5, 1}, {1, 0, -1}}, {4});
  result = study_transfer(scene);
  EXPECT_FALSE(result.waypoints->best_plan.has_value());
  EXPECT_NE(result.waypoints->failure.find("half of the orbital speed"), std::string::npos)
      << result.waypoints->failure;
  EXPECT_EQ(exit_code(result), 1);
}

}  // namespace
}  // namespace hamjet
