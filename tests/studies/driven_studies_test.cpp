#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "algebra/state_sums.hpp"
#include "driven_scenes.hpp"
#include "formats/jet_description.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"
#include "studies/bounded/bounded_formation.hpp"
#include "studies/bounded/event_study.hpp"
#include "studies/bounded/frozen_orbit_study.hpp"
#include "studies/checks/flight_checks.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/deputy_flows.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/formation/validity/flown_deputies.hpp"
#include "studies/stability/stability_errors.hpp"
#include "studies/uncertainty/uncertainty.hpp"
#include "support/errors.hpp"

// Whole studies of a chief whose forces depend on the time. Expected: flights by Boost.odeint with
// the impulses that the studies tell; what cannot be studied is refused.

namespace hamjet {
namespace {

using test::apart;
using test::driven_flight;

/// The driven chief with a transfer over two kilometres.
Scene with_transfer(std::vector<double> times) {
  Scene scene = driven_chief(4);
  TransferSettings settings;
  settings.start = {{900, -1200, 500}, {0.3, -0.2, 0.4}};
  settings.end = ArrivalState({-400, 800, -600}, {0, 0, 0});
  settings.times = std::move(times);
  settings.refine = true;
  scene.transfer = settings;
  return scene;
}

std::vector<double> chief_at(const Scene& scene, double time) {
  return driven_flight(scene.nominal, late, time);
}

/// The flight of the scene's deputy with impulses at their times, to a time.
class ImpulsiveFlight {
 public:
  explicit ImpulsiveFlight(const Scene& scene) : scene_(scene), units_(metric_units(scene)) {
    state_ = state_sum(scene.nominal, frame().deviation(scene.transfer->start));
  }

  void fly_to(double time) {
    state_ = driven_flight(state_, late + now_, time - now_);
    now_ = time;
  }
  void change(const Eigen::Vector3d& change_m_s) {
    const std::vector<double> impulse = frame().deviation({Eigen::Vector3d::Zero(), change_m_s});
    for (std::size_t i = 3; i < 6; ++i) state_[i] += impulse[i];
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

/// Metres that flights and their comparison may leave.
constexpr double flown_m = 3e-3;

TEST(DrivenStudies, Transfer) {
  Scene scene = with_transfer({1.0, 2.6, 3.5});
  scene.system.radius_km = 5000;
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
    double lowest = 1;
    for (int k = 1; k <= 400; ++k) {
      flight.fly_to(point.time * k / 400);
      lowest = std::min(lowest, position_of(flight.state()).norm());
    }
    ASSERT_TRUE(point.lowest.has_value());
    EXPECT_NEAR(*point.lowest, lowest, 1e-5);
    // The velocity at the end is right for the polynomials alone, to a part of their miss.
    flight.change(point.best().end_change_m_s);
    EXPECT_LT((flight.relative().velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 1e-3);
    // The Hamilton-Jacobi equation holds with the Hamiltonian of that time.
    if (point.hamilton_jacobi_residual) {
      EXPECT_LT(*point.hamilton_jacobi_residual, 1e-9);
    }
  }
}

// What the deputy drifts after its arrival is flown from the time of the arrival.
TEST(DrivenStudies, DriftAfterATransfer) {
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

TEST(DrivenStudies, Waypoints) {
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

TEST(DrivenStudies, CoastingStart) {
  Scene scene = with_transfer({2.2});
  scene.transfer->longest_coast = 2.5;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  const WaypointPlan& plan = *result.coasting->plan;
  ASSERT_EQ(plan.impulses.size(), 2U);
  EXPECT_GT(plan.impulses[0].time, 0.1);
  ImpulsiveFlight flight(scene);
  flight.fly_to(plan.impulses[0].time);
  flight.change(plan.impulses[0].change_m_s);
  flight.fly_to(plan.impulses[1].time);
  EXPECT_LT((flight.relative().position_m - scene.transfer->end.position_m).norm(), flown_m);
  flight.change(plan.impulses[1].change_m_s);
  EXPECT_LT((flight.relative().velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 1e-5);
}

TEST(DrivenStudies, OptimalImpulses) {
  Scene scene = with_transfer({4.0});
  scene.transfer->impulses = TransferImpulses::optimal;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal && result.optimal->is_found()) << result.optimal->failure;
  ImpulsiveFlight flight(scene);
  for (const Impulse& impulse : result.optimal->plan->impulses) {
    flight.fly_to(impulse.time);
    flight.change(impulse.change_m_s);
  }
  flight.fly_to(4.0);
  EXPECT_LT((flight.relative().position_m - scene.transfer->end.position_m).norm(), flown_m);
  EXPECT_LT((flight.relative().velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 1e-5);
}

TEST(DrivenStudies, DeputyMotion) {
  Scene scene = driven_chief(3);
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{900, -1200, 500}, {1, 0, -1}}};
  const DeputyMotion motion = study_deputy_motion(scene);
  const std::vector<double> deputy = motion.flown.deputy.front();
  for (std::size_t k = 0; k < motion.flown.times.size(); ++k) {
    const double time = motion.flown.times[k];
    EXPECT_LT(apart(motion.flown.chief[k], chief_at(scene, time)), 1e-10);
    EXPECT_LT(apart(motion.flown.deputy[k], driven_flight(deputy, late, time)), 1e-10);
  }
  // Polynomials of a flow from another time would miss by kilometres.
  EXPECT_LT(motion.largest_error_m(3), 0.1);
}

TEST(DrivenStudies, Validity) {
  Scene scene = driven_chief(3);
  const ComputedProblem problem = make_problem(scene);
  const Matrix6 axes = Matrix6::Identity();
  const double time = 3;
  const std::vector<double> chief = chief_at(scene, time);
  DeputyFlowPropagation propagation(scene, problem, precise_gauss(), JetCoordinates::cartesian);
  const auto flow = propagation.advance_to(time);
  FlownDeputies deputies(problem, axes, time, *flow, {});
  Vector6 coordinates;
  coordinates << 1e-3, -2e-3, 1e-3, 1e-3, 1e-3, -1e-3;
  const SixNumbers<double> deviation = deputies.deviation(coordinates);
  std::vector<double> deputy = scene.nominal;
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
  const std::vector<double> flown = driven_flight(deputy, late, time);
  const SixNumbers<double> predicted = flow->predict(deviation, 3).deviation;
  const Vector6 error = deputies.error(coordinates, 3);
  double size = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const double expected = predicted[i] + chief[i] - flown[i];
    EXPECT_NEAR(std::abs(error[static_cast<Eigen::Index>(i)]), std::abs(expected), 1e-10);
    size = std::max(size, std::abs(expected));
  }
  EXPECT_LT(size, 1e-8);
}

TEST(DrivenStudies, Uncertainty) {
  Scene scene = driven_chief(2);
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{900, -1200, 500}, {1, 0, -1}}};
  scene.uncertainty.emplace();
  StateUncertainty small;
  small.covariance = Covariance::of_standard_deviations(Vector<double>::Constant(6, 1e-6));
  scene.uncertainty->deputy = small;
  scene.uncertainty->times = {1.5, 3.5};
  scene.uncertainty->samples = 8;
  const MetricUnits units = metric_units(scene);
  const std::vector<double> deputy = state_sum(
      scene.nominal,
      ChiefFrame(scene.nominal, units, scene.deputy->frame).deviation(scene.deputy->start));
  const UncertaintyResult result = study_uncertainty(scene);
  ASSERT_EQ(result.points.size(), 2U);
  for (const UncertaintyAt& at : result.points) {
    const std::vector<double> chief = chief_at(scene, at.time);
    const RelativeState expected =
        ChiefFrame(chief, units, scene.uncertainty->frame)
            .relative(state_difference(driven_flight(deputy, late, at.time), chief));
    const auto state = std::find_if(at.states.begin(), at.states.end(),
                                    [](const UncertainState& s) { return s.name == "deputy"; });
    ASSERT_NE(state, at.states.end());
    EXPECT_LT((state->cartesian.back().mean().head(3) - expected.position_m).norm(), flown_m);
    ASSERT_EQ(state->flown_states.cols(), 8);
    for (const auto& column : state->flown_states.colwise()) {
      // A millimetre and a millionth of a metre a second grow by some tens.
      EXPECT_LT((column.head(3) - expected.position_m).norm(), 0.1);
    }
  }
}

TEST(DrivenStudies, SafetyAndCollision) {
  Scene scene = driven_chief(2);
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{900, -1200, 500}, {1, 0, -1}}};
  scene.uncertainty.emplace();
  StateUncertainty small;
  small.covariance = Covariance::of_standard_deviations(Vector<double>::Constant(6, 1e-3));
  scene.uncertainty->deputy = small;
  scene.uncertainty->times = {1.5};
  scene.uncertainty->samples = 0;
  SafetyWatch& safety = scene.uncertainty->safety.emplace();
  safety.from = 1;
  safety.to = 4;
  safety.keep_apart_m = 100;
  safety.burn_shares = {1};
  safety.samples = 200;
  CollisionWatch& collision = scene.uncertainty->collision.emplace();
  collision.radius_m = 50;
  collision.from = 1;
  collision.to = 4;
  collision.has_window = true;
  collision.samples = 2000;
  const MetricUnits units = metric_units(scene);
  const std::vector<double> deputy = state_sum(
      scene.nominal,
      ChiefFrame(scene.nominal, units, scene.deputy->frame).deviation(scene.deputy->start));
  double least = 1;
  for (int k = 0; k <= 3000; ++k) {
    const double time = 1 + 3.0 * k / 3000;
    least = std::min(
        least, (position_of(driven_flight(deputy, late, time)) - position_of(chief_at(scene, time)))
                   .norm());
  }
  const UncertaintyResult result = study_uncertainty(scene);
  ASSERT_EQ(result.safety->pairs.size(), 1U);
  EXPECT_NEAR(result.safety->pairs[0].mean_separation_m, least * units.length_m, 0.05);
  // The polynomials say the same as the flights of both.
  EXPECT_NEAR(result.safety->pairs[0].separations.separations.back(), least * units.length_m, 3);
  ASSERT_TRUE(result.collision.has_value());
  EXPECT_TRUE(result.collision->approaches.empty());
  EXPECT_TRUE(std::any_of(
      result.collision->warnings.begin(), result.collision->warnings.end(),
      [](const std::string& text) { return text.find("depend on the time") != text.npos; }));
}

/// Runs of the propagation study, and what flies back from their end.
TEST(DrivenStudies, PropagationThereAndBack) {
  Scene scene = driven_chief(2);
  scene.reference.emplace();
  const PropagationResult there = propagate(scene);
  ASSERT_EQ(there.runs.at(0).failure, "");
  EXPECT_LT(apart(there.runs[0].nominal_final, chief_at(scene, scene.duration)), 1e-10);
  ASSERT_TRUE(there.runs[0].error_by_degree.has_value());
  for (const double error : *there.runs[0].error_by_degree) EXPECT_LT(error, 1e-10);
  StabilityExpectation expected;
  expected.round_trip = true;
  const std::vector<MeasuredError> errors = measure_errors(expected, there, {});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_LT(errors[0].error, 1e-10);
  // Energy is not kept, and not judged; its change along the way is that of the Hamiltonian.
  for (const SelfCheck& check : there.runs[0].checks) {
    if (check.name == SelfCheckName::energy) {
      EXPECT_EQ(check.state, SelfCheckState::not_applicable);
    } else {
      EXPECT_NE(check.state, SelfCheckState::failed) << check.text;
    }
  }
  const auto energy = [](const std::vector<double>& z, double t) {
    const double r = position_of(z).norm(), c = std::cos(test::DrivenKepler::w * t),
                 s = std::sin(test::DrivenKepler::w * t);
    return momentum_of(z).squaredNorm() / 2 - 1 / r -
           test::DrivenKepler::a *
               (c * z[0] + s * z[1] + std::cos(2 * test::DrivenKepler::w * t + 1) / 2 * z[2]) -
           test::DrivenKepler::b * (c * (z[0] * z[0] - z[1] * z[1]) / 2 + s * z[0] * z[1]);
  };
  const double at_start = energy(scene.nominal, late);
  const NominalPoint& last = there.runs[0].nominal.back();
  EXPECT_NEAR(last.energy_error,
              (energy(last.state, late + last.time) - at_start) / std::abs(at_start), 1e-12);
}

TEST(DrivenStudies, ArcsAreThoseOfOneRun) {
  Scene scene = driven_chief(2);
  scene.arcs = 3;
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.at(0).failure, "");
  scene.arcs = 1;
  const PropagationResult whole = propagate(scene);
  const auto errors = relative_error_by_degree(result.runs[0].jet, whole.runs[0].jet);
  for (const double error : errors) EXPECT_LT(error, 1e-10);
}

TEST(DrivenStudies, FlightChecksAskNoEnergy) {
  Scene scene = driven_chief(1);
  scene.system.radius_km = 100;
  const std::vector<SelfCheck> checks = flight_checks(scene, flights_of(scene, 8, false));
  EXPECT_EQ(checks.at(0).state, SelfCheckState::not_applicable);
  double lowest = 1;
  for (int k = 0; k <= 4000; ++k) {
    lowest = std::min(lowest, position_of(chief_at(scene, 8.0 * k / 4000)).norm());
  }
  EXPECT_NEAR(*checks.at(1).value, lowest * scene.units.length_km, 1);
}

TEST(DrivenStudies, WhatNeedsAutonomyIsRefused) {
  const auto refused = [](const char* what, const auto& work) {
    test::expect_error(work, ErrorKind::scene, {"depend on the time"}, what);
  };
  refused("event", [] {
    Scene scene = driven_chief(1);
    scene.event.emplace();
    study_event(scene);
  });
  refused("bounded", [] {
    Scene scene = driven_chief(1);
    scene.bounded.emplace();
    study_bounded(scene);
  });
  refused("frozen orbit", [] { study_frozen_orbit(driven_chief(1)); });
  refused("flow box", [] {
    Scene scene = driven_chief(1);
    scene.coordinates = JetCoordinates::flow_box;
    scene.validity.emplace();
    scene.validity->times = {1};
    study_validity(scene);
  });
  refused("symmetry", [] {
    Scene scene = driven_chief(1);
    scene.symmetry = FlowSymmetry::rotation_and_time;
    make_problem(scene);
  });
}

}  // namespace
}  // namespace hamjet
