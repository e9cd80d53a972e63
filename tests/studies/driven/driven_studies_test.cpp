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
#include "hamjet/algebra/composition.hpp"
#include "hamjet/studies/validity.hpp"
#include "studies/bounded/bounded_formation.hpp"
#include "studies/bounded/event_study.hpp"
#include "studies/bounded/frozen_orbit_study.hpp"
#include "studies/checks/flight_checks.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/charts/deputy_flows.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/formation/two_point_flight.hpp"
#include "studies/formation/validity/flown_deputies.hpp"
#include "studies/stability/stability_errors.hpp"
#include "studies/uncertainty/uncertainty.hpp"
#include "support/errors.hpp"

// Whole studies of a chief whose forces depend on the time. Expected: flights by Boost.odeint;
// what cannot be studied is refused.

namespace hamjet {
namespace {

using test::apart;
using test::driven_flight;

/// A driven chief with a deputy some 1.6 km away.
Scene with_deputy(int order) {
  Scene scene = driven_chief(order);
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{900, -1200, 500}, {1, 0, -1}}};
  return scene;
}

std::vector<double> deputy_of(const Scene& scene) {
  const ChiefFrame frame(scene.nominal, metric_units(scene), scene.deputy->frame);
  return state_sum(scene.nominal, frame.deviation(scene.deputy->start));
}

/// The same with a deputy of these standard deviations, at these times.
Scene with_uncertainty(double deviation, std::vector<double> times) {
  Scene scene = with_deputy(2);
  StateUncertainty state;
  state.covariance = Covariance::of_standard_deviations(Vector<double>::Constant(6, deviation));
  scene.uncertainty.emplace();
  scene.uncertainty->deputy = state;
  scene.uncertainty->times = std::move(times);
  return scene;
}

TEST(DrivenStudies, DeputyMotion) {
  const Scene scene = with_deputy(3);
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
  FlownDeputies deputies(problem, axes, time, *flow, nullptr, {});
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
  Scene scene = with_uncertainty(1e-6, {1.5, 3.5});
  scene.uncertainty->samples = 8;
  const MetricUnits units = metric_units(scene);
  const std::vector<double> deputy = deputy_of(scene);
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
  Scene scene = with_uncertainty(1e-3, {1.5});
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
  const std::vector<double> deputy = deputy_of(scene);
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
  Scene scene = descending_chief(1);
  scene.system.radius_km = 100;
  const std::vector<SelfCheck> checks = flight_checks(scene, flights_of(scene, 7, false));
  EXPECT_EQ(checks.at(0).state, SelfCheckState::not_applicable);
  double lowest = 2;
  for (int k = 0; k <= 4000; ++k) {
    lowest = std::min(lowest, position_of(chief_at(scene, 7.0 * k / 4000)).norm());
  }
  EXPECT_LT(lowest, 1.1);
  EXPECT_NEAR(*checks.at(1).value, lowest * scene.units.length_km, 0.05);
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
  refused("symmetry", [] {
    Scene scene = driven_chief(1);
    scene.symmetry = FlowSymmetry::rotation_and_time;
    make_problem(scene);
  });
}

}  // namespace
}  // namespace hamjet
