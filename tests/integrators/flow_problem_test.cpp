#include "hamjet/integrators/flow_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/flow.hpp"

namespace hamjet {
namespace {

/// The oscillator over 0.5, continued from a jet; everything that the problem was made from is
/// destroyed or changed.
FlowProblem<double> problem_alone() {
  DynamicalSystem system = harmonic_oscillator(1, 1);
  FlowProblem<double> problem{system, SeriesSpace::create(2, 1), {0, 1},
                              {1, 0}, ClockTime::epoch(),        0.25};
  IntegrationStatistics statistics;
  const auto earlier = integrate_gauss<double>(problem, test::adaptive(), statistics);
  problem.initial_state = test::final_state(earlier);
  problem.initial_jet = earlier;
  problem.duration = 0.5;
  system = {};
  return problem;
}

// Expected: the rotation by 0.25 + 0.5.
TEST(FlowProblem, OutlivesAllThatItWasMadeFrom) {
  const FlowProblem<double> problem = problem_alone();
  IntegrationStatistics statistics;
  const auto jet = integrate_gauss<double>(problem, test::adaptive(), statistics);
  EXPECT_NEAR(jet[0][1], std::cos(0.75), 1e-15);
  EXPECT_NEAR(jet[0][2], std::sin(0.75), 1e-15);
  EXPECT_NEAR(jet[1][1], -std::sin(0.75), 1e-15);
  EXPECT_NEAR(jet[1][0], -std::sin(0.75), 1e-15);
}

TEST(FlowProblem, CopiesShareTheSystem) {
  FlowProblem<double> problem = problem_alone();
  const FlowProblem<double> copy = problem;
  const DynamicalSystem* system = &*problem.system;
  EXPECT_EQ(&*copy.system, system);
  problem.system = {};
  EXPECT_FALSE(problem.system);
  EXPECT_EQ(copy.system->degrees_of_freedom, 1U);
  problem = copy;
  EXPECT_EQ(&*problem.system, system);
}

}  // namespace
}  // namespace hamjet
