#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/keep_out_margin.hpp"
#include "relative_orbits.hpp"
#include "support/errors.hpp"
#include "uncertainty/cubic_arc.hpp"

// What has no solution says so: a solver's last number is never an answer.

namespace hamjet::test {
namespace {

TEST(SolverFailures, APathOfNoNumbersIsNotOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 6> start = {1, 0, 0, 0, 1, 0};
  const std::array<double, 6> end = {1, nan, 0, 0, 1, 0};
  expect_error(ErrorKind::numerical, "is not finite", [&] { SquaredDistance(start, end, 1); });
}

// A density that is a billion times as long as it is wide is a line, which a quadrature along
// directions does not see.
TEST(SolverFailures, ADensityThatIsTooFlatIsNotIntegrated) {
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.spacecraft[0].state = {1, 0, 0, 0, 1, 0};
  problem.spacecraft[1].state = {1, 0, 0, 0, 0.6, 0.8};
  problem.to = 1;
  problem.radius = 1e-3;
  problem.settings.tolerance = 1e-12;
  // The relative velocity is (0, -0.4, 0.8): R and (0, 2, 1) are across it.
  problem.spacecraft[1].factor.diagonal() << 1e-12, 1e-3, 1e-3, 0, 0, 0;
  expect_error(ErrorKind::numerical, "too flat", [&] { short_encounter(problem, 0); });
}

// A third of the orbit's radius away, after a revolution, the second order alone swings about.
TEST(SolverFailures, AMarginThatDoesNotSettle) {
  EncounterProblem problem = RelativeOrbit{0.1, 0.1, 1, 0.3}.problem(9, 2);
  problem.from = 7;
  problem.radius = 1e-3;
  problem.spacecraft[1].factor.diagonal().setConstant(0.1);
  expect_error(ErrorKind::numerical, "bends too much",
               [&] { keep_out_margin(problem, Eigen::Vector3d::Constant(1e-3)); });
}

}  // namespace
}  // namespace hamjet::test
