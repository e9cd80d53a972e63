#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "../support/errors.hpp"
#include "formation_scenes.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/formation/charted_boundary_values.hpp"
#include "studies/formation/two_point_flight.hpp"

// What has no solution says so: a solver's last number is never an answer.

namespace hamjet::test {
namespace {

/// Kepler's circle in the plane z = 0, mu and radius 1.
const std::vector<double> unit_circle = {1, 0, 0, 0, 1, 0};

SharedSystem kepler_system() { return make_system(kepler_chief(0, 7000, 806.8, 1)); }

// Half a revolution later no velocity out of the plane moves a body out of it.
TEST(SolverFailures, APlaceThatNoVelocityCommands) {
  const TwoPointFlight flight = fly_between(kepler_system(), unit_circle,
                                            Eigen::Vector3d(-1, 0, 0.1), std::numbers::pi, 1e-12);
  EXPECT_FALSE(flight.is_found());
  EXPECT_FALSE(flight.failure.empty());
}

// No flight is free of rounding.
TEST(SolverFailures, AMissThatNoFlightMeets) {
  const TwoPointFlight flight =
      fly_between(kepler_system(), unit_circle, Eigen::Vector3d(0.3, 0.8, 0.1), 1, -1);
  EXPECT_FALSE(flight.is_found());
  EXPECT_NE(flight.failure.find("canonical lengths off its end"), std::string::npos)
      << flight.failure;
}

// A flight that begins at the centre's doorstep ends in it, and says so in place of an answer.
TEST(SolverFailures, AFlightThroughTheCentre) {
  const std::vector<double> fall = {1, 0, 0, 0, 0, 0};
  const TwoPointFlight flight =
      fly_between(kepler_system(), fall, Eigen::Vector3d(0, 1, 0), 3, 1e-12);
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

}  // namespace
}  // namespace hamjet::test
