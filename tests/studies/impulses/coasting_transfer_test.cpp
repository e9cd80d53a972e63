#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "circle_transfers.hpp"
#include "support/errors.hpp"

// Transfers whose first impulse waits. Expected: closed forms, and the equations of Clohessy and
// Wiltshire metres from a circle at a hundred thousand starts.

namespace hamjet {
namespace {

Scene waiting(const RelativeState& start, double time, double longest) {
  Scene scene = metres_from_circle(start, time);
  scene.transfer->impulses = TransferImpulses::two;
  scene.transfer->longest_coast = longest;
  return scene;
}

/// The cost of two impulses at a given distance in time, after a wait, to rest at the chief; in
/// units of the mean motion times a metre.
double expected_cost(const Vector6& start, double wait, double time) {
  Vector6 z = clohessy_wiltshire(wait) * start;
  const Eigen::Matrix<double, 6, 6> flow = clohessy_wiltshire(time);
  const Eigen::Vector3d velocity =
      flow.topRightCorner<3, 3>().inverse() * (-flow.topLeftCorner<3, 3>() * z.head<3>());
  const double first = (velocity - z.tail<3>()).norm();
  z.tail<3>() = velocity;
  return first + (flow * z).tail<3>().norm();
}

double total_of(const TransferResult& result, const CoastingTransfer& coasting) {
  return coasting.plan->total_change_m_s() * result.scene.units.time_s;
}

// Out of the plane one impulse at the node is enough: n a |delta i|.
TEST(CoastingTransfer, WaitsForTheNode) {
  const TransferResult result = study_transfer(waiting({{0, 0, 3}, {0, 0, 4}}, 1, 4));
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  EXPECT_EQ(exit_code(result), 0);
  const WaypointPlan& plan = *result.coasting->plan;
  // In the plane z^2 / (2 r) = 2e-6 m are to be made up for within a radian, by the impulse that is
  // otherwise none.
  EXPECT_NEAR(total_of(result, *result.coasting), 5, 1e-4);
  // Either impulse is at the node, at which the cost has a corner.
  const double node = std::numbers::pi - std::atan(0.75);
  const bool is_first = std::abs(plan.legs[0].start - node) < std::abs(plan.duration - node);
  EXPECT_NEAR(is_first ? plan.legs[0].start : plan.duration, node, 1e-4);
  EXPECT_NEAR(plan.duration, plan.legs[0].start + 1, 1e-12);
  EXPECT_LT(plan.impulses[is_first ? 1 : 0].change_m_s.norm(),
            1e-4 * plan.impulses[is_first ? 0 : 1].change_m_s.norm());
  EXPECT_LE(plan.legs[0].miss_m, result.scene.transfer->refined_miss_m);
}

// From a lower circle, on which a deputy drifts by 3/2 of the height for each radian: it waits for
// the phase from which almost Hohmann's transfer leads to the chief.
TEST(CoastingTransfer, DriftsUntilThePhaseIsRight) {
  const RelativeState start = {{-1, -0.75 * std::numbers::pi - 3, 0}, {0, 1.5, 0}};
  const double time = 3, longest = 5;
  const TransferResult result = study_transfer(waiting(start, time, longest));
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  Vector6 z;
  z << start.position_m, start.velocity_m_s;
  double least = std::numeric_limits<double>::infinity();
  double best = 0;
  for (int k = 0; k <= 100000; ++k) {
    const double cost = expected_cost(z, longest * k / 100000, time);
    if (!(cost < least)) continue;
    least = cost;
    best = longest * k / 100000;
  }
  EXPECT_NEAR(total_of(result, *result.coasting), least, 1e-5);
  EXPECT_NEAR(result.coasting->plan->legs[0].start, best, 1e-2);
  EXPECT_GT(best, 1);
  EXPECT_LT(best, 3);
  EXPECT_LT(least, 0.6);  // The cost of Hohmann's transfer is 0.5.
}

// A wait of zero is one of the waits, and is flown as it is listed.
TEST(CoastingTransfer, CostsNoMoreThanThatWithoutAWait) {
  Scene scene = paper_chief(3);
  TransferSettings settings;
  settings.start.position_m = {300, -2000, 700};
  settings.times = {0.4 * paper_period, 0.7 * paper_period};
  settings.longest_coast = paper_period;
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  const WaypointPlan& plan = *result.coasting->plan;
  EXPECT_LE(plan.legs[0].miss_m, settings.refined_miss_m);
  EXPECT_GE(plan.legs[0].start, 0);
  EXPECT_LE(plan.legs[0].start, paper_period);
  for (const TransferPoint& point : result.points) {
    // Polynomials and flight agree to the tolerance of both.
    EXPECT_LT(plan.total_change_m_s(), point.change_m_s() * (1 + 1e-4));
  }
}

TEST(CoastingTransfer, ThatIsForbiddenIsSaid) {
  Scene scene = waiting({{0, 0, 3}, {0, 0, 4}}, 1, 4);
  scene.transfer->largest_impulse_m_s = 4 / scene.units.time_s;
  const TransferResult result = study_transfer(scene);
  EXPECT_FALSE(result.coasting->plan.has_value());
  EXPECT_NE(result.coasting->failure.find("above largest_impulse_m_s"), std::string::npos);
  EXPECT_EQ(exit_code(result), 1);
}

TEST(CoastingTransfer, AWaitThatIsTooLongNamesItsKeyBeforeTheWork) {
  test::expect_error(
      [] {
        study_transfer(waiting({{0, 0, 3}, {0, 0, 4}}, 1, 1e6),
                       [](const std::string& work, double) { ADD_FAILURE() << work; });
      },
      ErrorKind::too_large, {"transfer.longest_coast_s", "a shorter one is needed"},
      "a wait of 160 thousand revolutions");
}

}  // namespace
}  // namespace hamjet
