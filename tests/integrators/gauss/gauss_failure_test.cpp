#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "integrators/gauss/gauss_step_rule.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

// If there is no answer, or if a wrong one is near, the integrator must report it.

namespace hamjet {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const double not_a_number = std::nan("");

/// Kepler, e = 0.9 from perigee; energy -0.5.
test::Flow<double> eccentric_orbit(double duration, int order = 1) {
  return {kepler(), {0.1, 0, 0, 0, std::sqrt(19.0), 0}, duration, order, {}};
}

TEST(GaussMidpoint, RefusesTheDetachedRootOfAStepThatIsTooLong) {
  // The root connected to the start ends at h = 0.0334; from h = 0.15 on Newton's iteration finds
  // another one, whose map is symplectic and whose energy is positive (reference_cases.json,
  // midpoint_wrong_root).
  for (const double h : {0.05, 0.08, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0}) {
    SCOPED_TRACE(h);
    test::expect_error(ErrorKind::numerical, "no solution connected",
                       [&] { test::run_gauss(eccentric_orbit(h), test::fixed_step(1, h)); });
  }
}

TEST(GaussMidpoint, FollowsTheConnectedRootToItsEnd) {
  // Energies printed to four digits.
  const struct {
    double step;
    double energy;
  } table[] = {{0.005, -0.5019}, {0.01, -0.5275}, {0.02, -0.7951}, {0.03, -1.323}};
  for (const auto& row : table) {
    const auto flow = eccentric_orbit(row.step);
    const auto jet = test::run_gauss(flow, test::fixed_step(1, row.step));
    EXPECT_NEAR(test::energy(flow.system, test::final_state(jet)), row.energy,
                0.6e-3 * std::abs(row.energy))
        << "h = " << row.step;
  }
}

TEST(Gauss, AdaptiveStepsAvoidTheDetachedRoot) {
  const auto flow = eccentric_orbit(1);
  const auto jet = test::run_gauss(flow, test::adaptive(1, 1e-8));
  // The error of a step is 1e-8, and the energy is kept to about its square root in the worst case.
  EXPECT_NEAR(test::energy(flow.system, test::final_state(jet)), -0.5, 1e-4);
}

TEST(Gauss, CollisionIsAnError) {
  // From rest at r = 1 the body is in the centre at pi / (2 sqrt 2) = 1.1107.
  const test::Flow<double> fall{kepler(), {1, 0, 0, 0, 0, 0}, 2, 1, {}};
  for (const auto& settings :
       {test::adaptive(8), test::adaptive(2, 1e-8), test::adaptive(1, 1e-6)}) {
    test::expect_error(ErrorKind::numerical, "", [&] { test::run_gauss(fall, settings); });
  }
  test::expect_error(ErrorKind::numerical, "t = 1.11", [&] { test::run_gauss(fall); });
}

TEST(Gauss, CollapseUnderStrongOblatenessIsAnError) {
  // J2 = 0.5: r falls to 0 at t = 1.7610614 and at t = 39.5992863 (reference_cases.json).
  for (const char* id : {"J2HALF-PLUNGE", "J2HALF-CHAOS"}) {
    auto flow = test::flow_of(test::reference_orbit(id), 1);
    flow.duration = flow.duration < 2 ? 2 : 50;
    test::expect_error(ErrorKind::numerical, flow.duration < 5 ? "t = 1.761" : "t = 39.59",
                       [&] { test::run_gauss(flow); });
  }
}

TEST(Gauss, StartInTheCentreIsAnError) {
  const test::Flow<double> flow{kepler(), {0, 0, 0, 1, 0, 0}, 1, 1, {}};
  test::expect_error(ErrorKind::numerical, "not finite", [&] { test::run_gauss(flow); });
  test::expect_error(ErrorKind::numerical, "not finite",
                     [&] { test::run_gauss(flow, test::fixed_step(2, 0.1)); });
}

TEST(Gauss, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {not_a_number, infinite, -infinite}) {
    for (std::size_t i = 0; i < 6; ++i) {
      auto flow = eccentric_orbit(1);
      flow.start[i] = bad;
      test::expect_error(ErrorKind::numerical, "initial state", [&] { test::run_gauss(flow); });
    }
    test::expect_error(ErrorKind::numerical, "duration",
                       [&] { test::run_gauss(eccentric_orbit(bad)); });
  }
}

TEST(Gauss, AForceOutsideItsDomainIsAnError) {
  // H = p^2/2 + (1 - q)^(3/2): the force is not a number for q > 1, where the body arrives by t
  // = 1.
  const auto system = make_system(
      "wall", 1, [](auto q, auto p) { return p[0] * p[0] / 2 + pow(1 - q[0], Expression(1.5)); });
  const test::Flow<double> flow{system, {0, 4}, 2, 2, {}};
  test::expect_error(ErrorKind::numerical, "", [&] { test::run_gauss(flow); });
  test::expect_error(ErrorKind::numerical, "",
                     [&] { test::run_gauss(flow, test::fixed_step(3, 0.01)); });
}

/// Otherwise the next step would not be a number either, and the integration would not end.
TEST(GaussStepRule, AStepThatShowsNoNumberIsTooLong) {
  const GaussStepRule rule(8, true, 2, std::numeric_limits<double>::epsilon());
  const auto decaying = [](int degree) { return std::pow(0.1, degree); };
  StepMeasures good;
  good.defect = 1e-3;
  good.slope = good.first_gradient = good.last_gradient = good.largest_gradient = 1;
  EXPECT_LT(rule.error_estimate(good, 0.1, decaying), 1);
  StepMeasures bad = good;
  bad.largest_gradient = not_a_number;
  EXPECT_EQ(rule.error_estimate(bad, 0.1, decaying), infinite);
  bad = good;
  bad.defect = bad.slope = infinite;
  EXPECT_EQ(rule.error_estimate(bad, 0.1, decaying), infinite);
  EXPECT_EQ(rule.reduction(infinite, 1e-12), 0.5);
  bad.first_gradient = bad.last_gradient = infinite;
  EXPECT_EQ(rule.time_scale_ratio(bad), 1);
}

TEST(Gauss, RefusesSettingsOutOfRange) {
  const auto flow = eccentric_orbit(0.1);
  const auto refused = [&](const GaussSettings& settings, const char* text) {
    test::expect_error(ErrorKind::usage, text, [&] { test::run_gauss(flow, settings); });
  };
  refused(test::adaptive(0), "0 stages");
  refused(test::adaptive(17), "17 stages");
  refused(GaussSettings{}, "exactly one");
  auto both = test::adaptive();
  both.step = 0.1;
  refused(both, "exactly one");
  for (const double bad : {0.0, -1e-3, not_a_number}) {
    refused(test::fixed_step(8, bad), "positive");
    refused(test::adaptive(8, bad), "tolerance");
  }
  refused(test::adaptive(8, 1), "tolerance");
}

TEST(Gauss, AnInfiniteStepIsOneStepOrAnError) {
  // The integration must not count zero steps or go on without end.
  IntegrationStatistics statistics;
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, 0.5, 1, {}};
  try {
    test::run_gauss(flow, test::fixed_step(4, infinite), &statistics);
    EXPECT_EQ(statistics.steps, 1);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

TEST(Gauss, RefusesProblemsWhoseSizesDoNotFit) {
  IntegrationStatistics statistics;
  const auto flow = eccentric_orbit(0.1);
  const auto refused = [&](auto change) {
    FlowProblem<double> problem = test::problem_of(flow);
    change(problem);
    test::expect_error(ErrorKind::usage, "flow problem",
                       [&] { integrate_gauss(problem, test::adaptive(), statistics); });
  };
  refused([](auto& p) { p.system = {}; });
  refused([](auto& p) { p.space = nullptr; });
  refused([](auto& p) { p.initial_state.pop_back(); });
  refused([](auto& p) { p.variables.pop_back(); });
  refused([](auto& p) { p.variables[0] = 6; });
}

}  // namespace
}  // namespace hamjet
