#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/double_well.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "integrators/series_vector_field.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

namespace hamjet {
namespace {

FlowProblem<double> constant_problem(const SharedSystem& system, const std::vector<double>& start) {
  return {system, SeriesSpace::create(1, 0), {0}, start, ClockTime::epoch(), 1.0};
}

// A circle whose speed has become that of a parabola is another orbit, however coarse the tolerance
// and in whatever unit the energy, 1/(2r), is told.
TEST(EnergyGuard, NoticesAnotherOrbitInAnyUnitOfLength) {
  for (const double r : {4.7e-5, 1.0, 42164.0, 4.2e7, 1e9}) {
    for (const double tolerance : {1e-12, 1e-6, 1e-2}) {
      const double speed = 1 / std::sqrt(r);
      const std::vector<double> circle = {r, 0, 0, 0, speed, 0};
      const FlowProblem<double> problem = constant_problem(kepler(), circle);
      EnergyGuard<double> guard(problem, tolerance, "test");
      EXPECT_NO_THROW(guard.check(circle.data(), 1, 1.0));
      const std::vector<double> later = {0, r, 0, -speed, 0, 0};
      EXPECT_NO_THROW(guard.check(later.data(), 1, 1.0));
      const std::vector<double> parabola = {r, 0, 0, 0, std::numbers::sqrt2 * speed, 0};
      test::expect_error(ErrorKind::numerical, "left the solution",
                         [&] { guard.check(parabola.data(), 1, 1.0); });
    }
  }
}

// Near an equilibrium all terms of the energy vanish, and their rounding does not count as another
// motion.
TEST(EnergyGuard, KnowsTheRoundingOfTermsThatVanishAtTheStart) {
  const FlowProblem<double> problem = constant_problem(double_well(), {0, 1e-9});
  EnergyGuard<double> guard(problem, 1e-12, "test");
  // This state is in the middle of a well, on the way through both wells: p^2/2 = 1/8.
  std::vector<double> bottom = {1 / std::numbers::sqrt2, 0.5};
  EXPECT_NO_THROW(guard.check(bottom.data(), 1, 1.0));
  bottom[1] = 0.51;
  test::expect_error(ErrorKind::numerical, "left the solution",
                     [&] { guard.check(bottom.data(), 1, 1.0); });
}

}  // namespace
}  // namespace hamjet
