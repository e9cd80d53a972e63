#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "algebra/state_sums.hpp"
#include "driven_scenes.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/formation/two_point_flight.hpp"

// Transfers of a chief whose forces depend on the time. Expected: flights by Boost.odeint with the
// impulses that the studies tell.

namespace hamjet {
namespace {

using test::driven_flight;

/// A driven chief with a transfer over two kilometres.
Scene with_transfer(std::vector<double> times, Scene scene = driven_chief(4)) {
  TransferSettings settings;
  settings.start = {{900, -1200, 500}, {0.3, -0.2, 0.4}};
  settings.end = ArrivalState({-400, 800, -600}, {0, 0, 0});
  settings.times = std::move(times);
  settings.refine = true;
  scene.transfer = settings;
  return scene;
}

/// The flight of the scene's deputy with impulses at their times, to a time.
class ImpulsiveFlight {
 public:
  explicit ImpulsiveFlight(const Scene& scene) : scene_(scene), units_(metric_units(scene)) {
    state_ = state_sum(scene.nominal, frame().deviation(scene.transfer->start));
  }

  void fly_to(double time) {
    state_ = driven_flight(state_, scene_.start_time.in<double>() + now_, time - now_);
    now_ = time;
  }
  void change(const Eigen::Vector3d& change_m_s) {
    const std::vector<double> impulse = frame().deviation({Eigen::Vector3d::Zero(), change_m_s});
    for (std::size_t i = 3; i < 6; ++i) state_[i] += impulse[i];
  }
  /// All impulses, each at its time.
  void fly(const std::vector<Impulse>& impulses) {
    for (const Impulse& impulse : impulses) {
      fly_to(impulse.time);
      change(impulse.change_m_s);
    }
  }
  RelativeState relative() const {
    return frame().relative(state_difference(state_, chief_at(scene_, now_)));
  }
  const std::vector<double>& state() const { return state_; }

 private:
  ChiefFrame frame() const { return {chief_at(scene_, now_), units_, scene_.transfer->frame}; }

  const Scene& scene_;
  MetricUnits units_;
  std::vector<double> state_;
  double now_ = 0;
};

/// The end that the transfer asks for is reached, in position and velocity.
void expect_arrival(const ImpulsiveFlight& flight, const Scene& scene) {
  const RelativeState& end = scene.transfer->end;
  EXPECT_LT((flight.relative().position_m - end.position_m).norm(), flown_m);
  EXPECT_LT((flight.relative().velocity_m_s - end.velocity_m_s).norm(), 1e-5);
}

TEST(DrivenTransfers, Transfer) {
  Scene scene = with_transfer({1.0, 2.6, 3.5});
  scene.transfer->keep_out_m = Eigen::Vector3d(100, 200, 100);
  const TransferResult result = study_transfer(scene);
  ASSERT_EQ(result.points.size(), 3U);
  EXPECT_LT(result.chief_error_m, flown_m);
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer()) << point.failure;
    // The polynomials themselves bring it there.
    EXPECT_LT(point.answers.back().miss_m, 0.1);
    for (const TransferAnswer* answer : {&point.answers[0], &point.answers[3], &point.best()}) {
      ImpulsiveFlight flight(scene);
      flight.change(answer->start_change_m_s);
      flight.fly_to(point.time);
      const double miss = (flight.relative().position_m - scene.transfer->end.position_m).norm();
      EXPECT_NEAR(miss, answer->miss_m, flown_m) << point.time;
    }
    ImpulsiveFlight flight(scene);
    flight.change(point.best().start_change_m_s);
    double ratio = std::numeric_limits<double>::infinity();
    constexpr int places = 800;
    for (int k = 1; k <= places; ++k) {
      flight.fly_to(point.time * k / places);
      ratio = std::min(
          ratio, flight.relative().position_m.cwiseQuotient(*scene.transfer->keep_out_m).norm());
    }
    ASSERT_TRUE(point.keep_out_ratio.has_value());
    EXPECT_NEAR(*point.keep_out_ratio, ratio, 1e-3 * ratio);
    // The velocity at the end is that of the polynomials, and right only as far as they are.
    flight.change(point.best().end_change_m_s);
    EXPECT_LT((flight.relative().velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 1e-3);
    // The Hamilton-Jacobi equation holds of a symplectic map, with the forces of any time.
    ASSERT_TRUE(point.hamilton_jacobi_residual.has_value());
    EXPECT_LT(*point.hamilton_jacobi_residual, 1e-9);
  }
}

// What the deputy drifts after its arrival is flown from the time of the arrival.
TEST(DrivenTransfers, DriftAfterATransfer) {
  const Scene scene = with_transfer({2.6});
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.points.at(0).drift.has_value());
  const std::vector<double> chief = chief_at(scene, 2.6);
  const std::vector<double> deputy = state_sum(
      chief,
      ChiefFrame(chief, metric_units(scene), scene.transfer->frame).deviation(scene.transfer->end));
  // A revolution later, at the same place as the chief's, the deputy is that much later.
  const auto passage = [&](const std::vector<double>& state, double near) {
    const Eigen::Vector3d radial = position_of(chief).normalized();
    const Eigen::Vector3d along =
        position_of(chief).cross(momentum_of(chief)).normalized().cross(radial);
    double time = near;
    for (int i = 0; i < 20; ++i) {
      const auto z = driven_flight(state, late + 2.6, time);
      const double x = position_of(z).dot(radial), y = position_of(z).dot(along);
      time -= std::atan2(y, x) * (x * x + y * y) /
              (x * momentum_of(z).dot(along) - y * momentum_of(z).dot(radial));
    }
    return time;
  };
  const double period = 2 * std::numbers::pi * std::pow(0.7, -1.5);
  const double difference =
      passage(deputy, period) - passage(deputy, 0) - (passage(chief, period) - passage(chief, 0));
  EXPECT_NEAR(result.points[0].drift->period_difference_s / scene.units.time_s, difference, 1e-9);
}

TEST(DrivenTransfers, Waypoints) {
  Scene scene = with_transfer({3.6});
  scene.transfer->waypoints = {{1.1, {300, -900, 200}}, {2.4, {-200, -400, -300}}};
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.waypoints.has_value());
  ASSERT_TRUE(result.waypoints->best_plan.has_value()) << result.waypoints->failure;
  const WaypointPlan& plan = result.waypoints->plans[*result.waypoints->best_plan];
  ASSERT_EQ(plan.impulses.size(), 4U);
  ImpulsiveFlight flight(scene);
  for (std::size_t k = 0; k < 4; ++k) {
    flight.fly_to(plan.impulses[k].time);
    if (k > 0) {
      const Eigen::Vector3d place =
          k < 3 ? scene.transfer->waypoints[k - 1].position_m : scene.transfer->end.position_m;
      EXPECT_LT((flight.relative().position_m - place).norm(), flown_m) << k;
    }
    flight.change(plan.impulses[k].change_m_s);
  }
  EXPECT_LT((flight.relative().velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 1e-5);
}

TEST(DrivenTransfers, CoastingStart) {
  Scene scene = with_transfer({1.2});
  scene.transfer->start = {{100, -200, 1500}, {0, 0, 0}};
  scene.transfer->end = ArrivalState({0, 0, 0}, {0, 0, 0});
  scene.transfer->longest_coast = 5;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  const WaypointPlan& plan = *result.coasting->plan;
  ASSERT_EQ(plan.impulses.size(), 2U);
  ImpulsiveFlight flight(scene);
  flight.fly(plan.impulses);
  expect_arrival(flight, scene);
}

TEST(DrivenTransfers, OptimalImpulses) {
  Scene scene = with_transfer({4.0});
  scene.transfer->impulses = TransferImpulses::optimal;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal && result.optimal->is_found()) << result.optimal->failure;
  ImpulsiveFlight flight(scene);
  flight.fly(result.optimal->plan->impulses);
  flight.fly_to(4.0);
  expect_arrival(flight, scene);
}

/// The least distance from the centre of a flight with impulses to a time.
double lowest_of(const Scene& scene, const std::vector<Impulse>& impulses, double end) {
  ImpulsiveFlight flight(scene);
  double lowest = std::numeric_limits<double>::infinity();
  double now = 0;
  const auto fly_to = [&](double time) {
    constexpr int places = 300;
    for (int k = 1; k <= places; ++k) {
      flight.fly_to(now + (time - now) * k / places);
      lowest = std::min(lowest, position_of(flight.state()).norm());
    }
    now = time;
  };
  for (const Impulse& impulse : impulses) {
    if (impulse.time > now) fly_to(impulse.time);
    flight.change(impulse.change_m_s);
  }
  if (end > now) fly_to(end);
  return lowest;
}

/// The kilometres below the surface that a refusal tells.
double depth_in(const std::string& forbidden) {
  const std::string before = "passes ";
  const std::size_t place = forbidden.find(before);
  return place == forbidden.npos ? -1 : std::stod(forbidden.substr(place + before.size()));
}

// A surface above the perigee: all ways down to it are told how far below they pass.
TEST(DrivenTransfers, WaysBelowTheSurface) {
  Scene scene = with_transfer({5.6}, descending_chief(4));
  scene.system.radius_km = 7200;
  scene.transfer->waypoints = {{1.4, {300, -900, 200}}};
  scene.transfer->impulses = TransferImpulses::optimal;
  const TransferResult result = study_transfer(scene);
  const TransferPoint& point = result.points.at(0);
  ASSERT_TRUE(point.has_answer() && point.lowest) << point.failure;
  const double unit_km = scene.units.length_km;
  EXPECT_NEAR(*point.lowest, lowest_of(scene, {{0, point.best().start_change_m_s}}, 5.6), 1e-5);
  const WaypointPlan& plan = result.waypoints->plans.at(0);
  ASSERT_EQ(plan.impulses.size(), 3U);
  EXPECT_NEAR(depth_in(plan.forbidden), 7200 - unit_km * lowest_of(scene, plan.impulses, 5.6), 0.05)
      << plan.forbidden;
  ASSERT_TRUE(result.optimal && result.optimal->plan);
  const ImpulsePlan& optimal = *result.optimal->plan;
  EXPECT_NEAR(depth_in(optimal.forbidden), 7200 - unit_km * lowest_of(scene, optimal.impulses, 5.6),
              0.05)
      << optimal.forbidden;
}

// The way that waits for its first impulse passes its perigee meanwhile.
TEST(DrivenTransfers, CoastBelowTheSurface) {
  Scene scene = with_transfer({1.2}, descending_chief(4));
  scene.transfer->start = {{0, 0, 1500}, {0, 0, 0.5}};
  scene.transfer->end = ArrivalState({0, 0, 0}, {0, 0, 0});
  scene.transfer->longest_coast = 9;
  const TransferResult free = study_transfer(scene);
  ASSERT_TRUE(free.coasting && free.coasting->plan) << free.coasting->failure;
  const WaypointPlan& plan = *free.coasting->plan;
  EXPECT_GT(plan.impulses[0].time, 5);
  scene.system.radius_km = 7200;
  const TransferResult forbidden = study_transfer(scene);
  EXPECT_NEAR(depth_in(forbidden.coasting->failure),
              7200 - scene.units.length_km * lowest_of(scene, plan.impulses, plan.duration), 0.05)
      << forbidden.coasting->failure;
}

}  // namespace
}  // namespace hamjet
