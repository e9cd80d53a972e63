#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../support/errors.hpp"
#include "dynamics/double_well.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "formation_scenes.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/validity.hpp"
#include "studies/comparison/convergence_fit.hpp"
#include "studies/flights/extreme_distance.hpp"
#include "studies/formation/charts/charted_boundary_values.hpp"
#include "studies/formation/impulses/impulse_search.hpp"
#include "studies/formation/impulses/least_impulses.hpp"
#include "studies/formation/lambert.hpp"
#include "studies/formation/two_point_flight.hpp"
#include "studies/lowest_point.hpp"
#include "studies/stability/stability_limit.hpp"
#include "studies/uncertainty/process_noise.hpp"

// What has no solution says so: a solver's last number is never an answer.

namespace hamjet::test {
namespace {

/// Kepler's circle in the plane z = 0, mu and radius 1.
const std::vector<double> unit_circle = {1, 0, 0, 0, 1, 0};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SharedSystem kepler_system() { return make_system(kepler_chief(0, 7000, 806.8, 1)); }

// Half a revolution later no velocity out of the plane moves a body out of it.
TEST(SolverFailures, APlaceThatNoVelocityCommands) {
  const TwoPointFlight flight = fly_between(kepler_system(), unit_circle, ClockTime::epoch(),
                                            Eigen::Vector3d(-1, 0, 0.1), std::numbers::pi, 1e-12);
  EXPECT_FALSE(flight.is_found());
  EXPECT_FALSE(flight.failure.empty());
}

// No flight is free of rounding.
TEST(SolverFailures, AMissThatNoFlightMeets) {
  const TwoPointFlight flight = fly_between(kepler_system(), unit_circle, ClockTime::epoch(),
                                            Eigen::Vector3d(0.3, 0.8, 0.1), 1, -1);
  EXPECT_FALSE(flight.is_found());
  EXPECT_NE(flight.failure.find("canonical lengths off its end"), std::string::npos)
      << flight.failure;
}

// A flight that begins at the centre's doorstep ends in it, and says so in place of an answer.
TEST(SolverFailures, AFlightThroughTheCentre) {
  const std::vector<double> fall = {1, 0, 0, 0, 0, 0};
  const TwoPointFlight flight =
      fly_between(kepler_system(), fall, ClockTime::epoch(), Eigen::Vector3d(0, 1, 0), 3, 1e-12);
  EXPECT_FALSE(flight.is_found());
  EXPECT_FALSE(flight.failure.empty());
}

// A million kilometres away from a low orbit no polynomial leads.
TEST(SolverFailures, APlaceBeyondTheReachOfPolynomialsInCharts) {
  const ZonalGravity field;
  GaussSettings gauss;
  gauss.tolerance = 1e-12;
  FlowBoxPropagation<double> propagation(field, ChartName::nodal,
                                         {1, 0, 0, 0, std::cos(0.9), std::sin(0.9)}, 3, gauss);
  const auto flow = flow_box_deputy_flow(field, propagation.advance_to(1.3));
  ChartedBoundaryValues boundary(*flow);
  const std::vector<double> first = {0, 0, 0};
  const std::vector<double> last = {100, 80, 60};
  const std::vector<double> guess = {0, 0, 0};
  expect_error(ErrorKind::numerical, "lead to no such place",
               [&] { boundary.solve(first, last, 3, guess); });
}

// On top of its barrier the well's flow grows as e^t, and after 800 beyond every number.
TEST(SolverFailures, SingularTimesOfAFlowThatOverflows) {
  ComputedProblem problem;
  problem.system = double_well();
  problem.variables = {0, 1};
  problem.nominal = {0, 0};
  const LinearFlow flow(problem, 800, 4);
  expect_error(ErrorKind::numerical, "singular times",
               [&] { find_singular_times(flow, parse_kind("F1", 1)); });
}

TEST(SolverFailures, StepsWhoseMatrixIsNoNumberAreUnstable) {
  LinearSteps steps;
  steps.method = "method";
  steps.step = 1;
  steps.duration = 10;
  steps.matrix = [](double step) -> Matrix<double> {
    return Matrix<double>::Identity(2, 2) * (step > 0.5 ? nan : 1);
  };
  expect_error(ErrorKind::numerical, "unstable",
               [&] { require_stable_steps(harmonic_oscillator(1, 1), steps); });
}

TEST(SolverFailures, AFlightOfNoNumbersHasNoExtremeDistance) {
  const SpacePointer space = SeriesSpace::create(1, 3);
  const FlightArc arc{0, 1, {}};
  const ArcCurve curve = {Series<double>(space, 1), Series<double>(space, nan),
                          Series<double>(space, 1)};
  ExtremeDistance least(ExtremeDistance::Kind::least);
  expect_error(ErrorKind::numerical, "distance", [&] { least.add(arc, curve); });
}

TEST(SolverFailures, EllipsesInNoTime) {
  expect_error(ErrorKind::numerical, "ellipses between two places", [&] {
    lambert_ellipses({1, 0, 0}, {0, 1.2, 0}, nan, 0, {0, 0, 1});
  });
}

// Four times the same effect reach three directions of six.
TEST(SolverFailures, ImpulsesThatDoNotReachTheChangeStay) {
  ImpulseEffect effect;
  for (Eigen::Index i = 0; i < effect.size(); ++i) {
    effect(i) = std::sin(1 + static_cast<double>(i * i));
  }
  const std::vector<ImpulseEffect> effects(4, effect);
  std::vector<Eigen::Vector3d> impulses(4, Eigen::Vector3d::Zero());
  EXPECT_FALSE(
      add_change(effects, impulses, {1, 1, 1, 1}, Eigen::Matrix<double, 6, 1>::Constant(1)));
  EXPECT_TRUE(impulses[0].isZero(0));
}

// A passage that is recorded where a fall ends in the centre.
TEST(SolverFailures, ALowestPointInTheCentre) {
  ComputedProblem problem;
  problem.system = kepler_system();
  LowestPointSearch search(problem);
  search.record(0, {1, 0, 0, -1e-3, 0, 0});
  search.record(3, {1, 0, 0, 1e-3, 0, 0});
  EXPECT_FALSE(search.take().failure.empty());
}

// Of a period that is told a million times too long, 16 to 1024 intervals see 400 revolutions of
// e = 0.3 by chance.
TEST(SolverFailures, NoiseThatDoesNotSettle) {
  const Scene scene = kepler_chief(0.3, 7000, 806.8, 1);
  const ComputedProblem problem = make_problem(scene);
  IntegratorSettings settings = precise_gauss();
  settings.tolerance = 1e-6;
  const ProcessNoise noise(problem, settings, 1, 1e6 * paper_period);
  expect_error(ErrorKind::numerical, "does not settle", [&] { noise.at(400.3 * paper_period); });
}

// Flights round to more than this.
TEST(SolverFailures, NoReachIsProvedBelowRounding) {
  Scene scene = kepler_chief(0.3, 7000, 806.8, 2);
  scene.validity = ValiditySettings();
  scene.validity->tolerance_m = 1e-9;
  scene.validity->times = {3.0};
  scene.validity->samples = 5;
  const ValidityResult result = study_validity(scene);
  ASSERT_FALSE(result.points.back().entries.empty());
  for (const ValidityEntry& entry : result.points.back().entries) {
    EXPECT_EQ(entry.proved_m, 0) << entry.order;
  }
}

// Both ends have the same effect: what one asks for the other forbids.
TEST(SolverFailures, APrimerThatItsEndsDoNotTell) {
  ImpulseGrid grid;
  grid.add(0, Eigen::Matrix<double, 6, 6>::Identity());
  grid.add(1, Eigen::Matrix<double, 6, 6>::Identity());
  EXPECT_FALSE(primer_between(grid, {1, 0, 0}, {0, 1, 0}));
}

// Errors that alternate by a factor of ten are on no line.
TEST(SolverFailures, PointsThatScatterHaveNoOrder) {
  std::vector<ConvergencePoint> points;
  for (int k = 0; k < 4; ++k) points.push_back({std::pow(2, k), k % 2 == 0 ? 1e-3 : 1e-2, ""});
  EXPECT_FALSE(fitted_slope(points, 0));
  points[1].error = nan;
  EXPECT_FALSE(fitted_slope(points, 0));
}

}  // namespace
}  // namespace hamjet::test
