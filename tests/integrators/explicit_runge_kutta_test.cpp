#include "hamjet/integrators/explicit_runge_kutta.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "integrator_checks.hpp"
#include "support/convergence.hpp"

namespace hamjet {
namespace {

template <class Real>
FlowJet<Real> run(const FlowProblem<Real>& problem, const ExplicitRungeKuttaSettings& settings) {
  IntegrationStatistics statistics;
  return integrate_fehlberg78(problem, settings, statistics);
}

ExplicitRungeKuttaSettings fixed(double step) { return {.step = step}; }
ExplicitRungeKuttaSettings controlled(double tolerance) { return {.tolerance = tolerance}; }

/// Kind and text of the error that an integration ends with.
std::string error_text(const FlowProblem<double>& problem,
                       const ExplicitRungeKuttaSettings& settings, ErrorKind kind) {
  try {
    run(problem, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "no error";
}

TEST(Fehlberg78, IntegratesTheOscillatorForwardsAndBackwards) {
  const DynamicalSystem system = harmonic_oscillator(2, 0.5);
  for (const double duration : {7.3, -7.3}) {
    test::expect_rotation(run(test::oscillator_problem(system, duration), fixed(0.1)), duration,
                          1e-14);
    test::expect_rotation(run(test::oscillator_problem(system, duration), controlled(1e-13)),
                          duration, 1e-12);
    test::expect_rotation(
        run(test::oscillator_problem<Extended>(system, duration), controlled(1e-22)), duration,
        1e-21);
  }
}

// Expected: the state of case SEED-10PI in reference_cases.json, and its degree 1 (the matrix's
// first column). Global errors of a controlled run are some multiple of the tolerance.
TEST(Fehlberg78, ErrorFallsWithTheToleranceOnThePapersOrbit) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  const auto problem = test::orbit_problem(system, 2, test::paper_orbit().duration);
  double previous = 1;
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const double error = test::paper_orbit_error(run(problem, controlled(tolerance)));
    EXPECT_LE(error, 10 * tolerance);
    EXPECT_LE(error, previous / 20) << tolerance;
    previous = error;
  }
}

// Expected: the flow back over the same time undoes the flow: the nominal returns, and the map out
// of the new start composed with the map out is the identity (here its degree 1, a matrix product).
TEST(Fehlberg78, ForwardThenBackwardIsTheIdentity) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  const FlowJet<double> out = run(test::orbit_problem(system, 1, 5), controlled(1e-13));
  FlowProblem<double> back = test::orbit_problem(system, 1, -5);
  for (std::size_t c = 0; c < 6; ++c) back.initial_state[c] = out[c][0];
  const FlowJet<double> home = run(back, controlled(1e-13));
  test::expect_return(out, home, test::orbit_problem(system, 1, 5).initial_state, 1e-11, 1e-10);
}

// Expected: odeint carries on the result of order 8 (its b weights are Fehlberg's eighth-order
// ones), so errors go as the 8th power of the step; the same order holds for every coefficient of
// the jet, because a Runge-Kutta method commutes with differentiation. The circular orbit of
// Kepler's problem and its jet in closed form: x = 1 - 18 pi^2 d^2 and y = -6 pi d - 24 pi d^2
// after a revolution from (1, 0) with the velocity (0, 1 + d).
TEST(Fehlberg78, HasOrderEight) {
  const DynamicalSystem system = kepler();
  const Extended pi = acos(Extended(-1));
  const FlowProblem<Extended> problem{
      system,          SeriesSpace::create(1, 2), {4}, {1, 0, 0, 0, 1, 0}, ClockTime::epoch(),
      Extended(2 * pi)};
  std::vector<std::vector<double>> errors;
  const std::vector<int> steps{40, 57, 80, 113, 160};
  for (const int n : steps) {
    IntegrationStatistics statistics;
    const FlowJet<Extended> jet =
        integrate_fehlberg78(problem, fixed(static_cast<double>(problem.duration) / n), statistics);
    EXPECT_EQ(statistics.steps, n);
    const auto error = [](const Extended& value) { return std::abs(static_cast<double>(value)); };
    errors.push_back({error(Extended(jet[1][0])), error(Extended(jet[1][1] + 6 * pi)),
                      error(Extended(jet[0][2] + 18 * pi * pi)),
                      error(Extended(jet[1][2] + 24 * pi))});
  }
  for (std::size_t quantity = 0; quantity < errors[0].size(); ++quantity) {
    std::vector<double> of_quantity;
    for (const auto& row : errors) of_quantity.push_back(row[quantity]);
    EXPECT_NEAR(test::fitted_order({steps.begin(), steps.end()}, of_quantity), -8, 0.3) << quantity;
  }
}

// Expected: Gauss, by definition, is asked for the same thing elsewhere; here both precisions of
// the same method agree to what double precision and the step allow.
TEST(Fehlberg78, ExtendedPrecisionAgreesWithDouble) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  const FlowJet<double> plain = run(test::orbit_problem(system, 2, 1), fixed(0.05));
  const FlowJet<Extended> extended = run(test::orbit_problem<Extended>(system, 2, 1), fixed(0.05));
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t k = 0; k < plain[c].size(); ++k) {
      EXPECT_NEAR(plain[c][k], static_cast<double>(extended[c][k]), 1e-13);
    }
  }
}

// Expected: by definition of the flow at time zero.
TEST(Fehlberg78, ZeroDurationIsTheIdentityExactly) {
  const DynamicalSystem system = kepler();
  IntegrationStatistics statistics;
  const auto problem = test::orbit_problem(system, 2, 0);
  for (const auto& settings : {fixed(0.1), controlled(1e-9)}) {
    const FlowJet<double> jet = integrate_fehlberg78(problem, settings, statistics);
    test::expect_identity(jet, problem.initial_state);
  }
  EXPECT_EQ(statistics.steps, 0);
}

// Expected: 1 / 0.3 rounded up is 4 equal steps; the observer sees each, the last at exactly 1.
TEST(Fehlberg78, EqualStepsEndExactlyWhereTheSpanEnds) {
  const DynamicalSystem system = kepler();
  for (const double sign : {1.0, -1.0}) {
    IntegrationStatistics statistics;
    std::vector<double> times;
    const auto jet = integrate_fehlberg78<double>(
        test::orbit_problem(system, 1, sign), fixed(0.3), statistics,
        [&](double time, const FlowJet<double>&) { times.push_back(time); });
    EXPECT_EQ(times, (std::vector<double>{sign * 0.25, sign * 0.5, sign * 0.75, sign}));
    EXPECT_EQ(statistics.steps, 4);
    EXPECT_EQ(statistics.rejected_steps, 0);
  }
}

TEST(Fehlberg78, TheObserverSeesEveryStepAndTheLastJet) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  IntegrationStatistics statistics;
  long calls = 0;
  double last_time = 0;
  double last_value = 0;
  const FlowJet<double> jet =
      integrate_fehlberg78<double>(test::orbit_problem(system, 2, -3), controlled(1e-9), statistics,
                                   [&](double time, const FlowJet<double>& now) {
                                     EXPECT_LT(time, last_time);
                                     last_time = time;
                                     last_value = now[2][7];
                                     ++calls;
                                   });
  EXPECT_EQ(calls, statistics.steps);
  EXPECT_EQ(last_time, -3);
  EXPECT_EQ(last_value, jet[2][7]);
  // There are 13 stages in a step; repetitions of a step share the first stage.
  EXPECT_LE(statistics.vector_field_evaluations,
            13 * statistics.steps + 12 * statistics.rejected_steps);
}

// A fall from rest at distance 1 meets the centre at pi / (2 sqrt 2) = 1.1107 (case RECT-1.0 in
// reference_cases.json); there is no answer behind it.
TEST(Fehlberg78, ACollisionIsAnError) {
  const DynamicalSystem system = kepler();
  FlowProblem<double> problem = test::orbit_problem(system, 2, 2);
  problem.initial_state = {1, 0, 0, 0, 0, 0};
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-13}) {
    const std::string text = error_text(problem, controlled(tolerance), ErrorKind::numerical);
    EXPECT_NE(text.find(" t = 1.1"), std::string::npos) << text;
  }
  for (const double step : {0.5, 0.1, 0.01, 0.001}) {
    const std::string text = error_text(problem, fixed(step), ErrorKind::numerical);
    EXPECT_NE(text.find("left the solution"), std::string::npos) << text;
  }
  problem.initial_state = {0, 0, 0, 0, 1, 0};
  EXPECT_NE(error_text(problem, controlled(1e-9), ErrorKind::numerical).find("not finite"),
            std::string::npos);
}

// Expected: case RECT-1.11 in reference_cases.json, just before the collision.
TEST(Fehlberg78, IntegratesCloseToACollision) {
  const DynamicalSystem system = kepler();
  FlowProblem<double> problem = test::orbit_problem(system, 1, 0x1.1c28f5c28f5c3p+0);
  problem.initial_state = {1, 0, 0, 0, 0, 0};
  const FlowJet<double> jet = run(problem, controlled(1e-13));
  EXPECT_NEAR(jet[0][0], 0.0132362652092382376, 1e-10);
  EXPECT_NEAR(jet[0][1], 20.3439720109499775, 1e-7);
  EXPECT_EQ(jet[1][0], 0);
  EXPECT_EQ(jet[0][2], 0);
}

TEST(Fehlberg78, RefusesWrongInput) {
  const DynamicalSystem system = kepler();
  const auto problem = test::orbit_problem(system, 1, 1);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ExplicitRungeKuttaSettings& settings :
       {ExplicitRungeKuttaSettings{}, ExplicitRungeKuttaSettings{0.1, 1e-9}, fixed(0), fixed(-0.1),
        fixed(nan), controlled(0), controlled(-1e-9), controlled(1), controlled(nan),
        controlled(1e-20)}) {
    EXPECT_NE(error_text(problem, settings, ErrorKind::usage), "no error");
  }
  EXPECT_NE(error_text(problem, fixed(1e-15), ErrorKind::too_large), "no error");
  for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
    FlowProblem<double> broken = problem;
    broken.initial_state[4] = bad;
    EXPECT_NE(error_text(broken, controlled(1e-9), ErrorKind::numerical), "no error");
    broken = problem;
    broken.duration = bad;
    EXPECT_NE(error_text(broken, fixed(0.1), ErrorKind::numerical), "no error");
  }
}

}  // namespace
}  // namespace hamjet
