#include "hamjet/integrators/flow_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/errors.hpp"
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
  problem.start_time = problem.start_time + problem.duration;
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

// The time at which a state stands has no default, and no number is taken for it.
template <class Problem>
concept DoesWithoutStartTime = requires(SharedSystem system, SpacePointer space) {
  Problem{system, space, {0, 1}, {1.0, 0.0}, 0.25};
};
template <class Problem>
concept TakesStartTime = requires(SharedSystem system, SpacePointer space) {
  Problem{system, space, {0, 1}, {1.0, 0.0}, ClockTime(0.5), 0.25};
};
static_assert(TakesStartTime<FlowProblem<double>>);
static_assert(!DoesWithoutStartTime<FlowProblem<double>>);
static_assert(!std::is_default_constructible_v<FlowProblem<double>>);
static_assert(!std::is_default_constructible_v<ClockTime>);
static_assert(!std::is_convertible_v<double, ClockTime>);

TEST(FlowProblem, StartsAtAFiniteTime) {
  FlowProblem<double> problem = problem_alone();
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    problem.start_time = ClockTime(bad);
    test::expect_error(ErrorKind::numerical, "the start time is not finite",
                       [&] { validate(problem); });
  }
}

// Durations are added without the rounding of double precision.
TEST(ClockTime, CountsOn) {
  ClockTime time(1e9);
  for (int k = 0; k < 1000; ++k) time = time + 1e-9;
  EXPECT_DOUBLE_EQ((time + -1e9).in<double>(), 1e-6);
  EXPECT_TRUE(ClockTime::epoch() + 2.0 == ClockTime(2));
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
