#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <hamjet/algebra/extended.hpp>
#include <hamjet/dynamics/harmonic_oscillator.hpp>
#include <hamjet/dynamics/zonal_gravity.hpp>
#include <hamjet/error.hpp>
#include <hamjet/integrators/explicit_runge_kutta.hpp>
#include <limits>
#include <string>
#include <vector>

#include "support/convergence.hpp"

namespace hamjet {
namespace {

constexpr double paper_time = 0x1.f6a7a2955385ep+4;  // 10 pi in binary64

/// The paper's orbit; inputs from reference_cases.json, case SEED-10PI.
DynamicalSystem paper_field() {
  return zonal_gravity(
      {1.0, 0x1.d283e1c01dcf3p-1, {{2, 0x1.1bcdd8a6cfd70p-10}, {3, 0x1.53e5d6a0f845cp-19}}});
}

template <class Real>
FlowProblem<Real> orbit(const DynamicalSystem& system, int order, double duration) {
  return {&system,
          SeriesSpace::create(6, order),
          {0, 1, 2, 3, 4, 5},
          {1, 0, 0, 0, 0x1.23e2896280f23p-1, 0x1.f98f3adef13f2p-1},
          Real(duration)};
}

/// q and p of an oscillator of mass 2 and stiffness 0.5 (frequency 1/2), from q = 0.3, p = -0.7.
template <class Real>
FlowProblem<Real> oscillator_problem(const DynamicalSystem& system, double duration) {
  return {&system, SeriesSpace::create(2, 3), {0, 1}, {Real(0.3), Real(-0.7)}, Real(duration)};
}

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

// Expected: q = q0 cos wt + p0/(m w) sin wt, p = p0 cos wt - m w q0 sin wt, here with m w = 1; the
// coefficients of degree 1 are those of this rotation, and a linear flow has none above.
template <class Real>
void expect_rotation(const FlowJet<Real>& jet, double duration, double tolerance) {
  using std::abs;
  using std::cos;
  using std::sin;
  const Real angle = Real(duration) / 2;
  const Real c = cos(angle);
  const Real s = sin(angle);
  const Real q0 = 0.3;
  const Real p0 = -0.7;
  const std::vector<Real> expected_q{q0 * c + p0 * s, c, s};
  const std::vector<Real> expected_p{p0 * c - q0 * s, -s, c};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(static_cast<double>(abs(jet[0][k] - expected_q[k])), tolerance) << k;
    EXPECT_LE(static_cast<double>(abs(jet[1][k] - expected_p[k])), tolerance) << k;
  }
  for (std::size_t k = 3; k < jet[0].size(); ++k) {
    EXPECT_EQ(jet[0][k], 0);
    EXPECT_EQ(jet[1][k], 0);
  }
}

TEST(Fehlberg78, IntegratesTheOscillatorForwardsAndBackwards) {
  const DynamicalSystem system = harmonic_oscillator(2, 0.5);
  for (const double duration : {7.3, -7.3}) {
    expect_rotation(run(oscillator_problem<double>(system, duration), fixed(0.1)), duration, 1e-14);
    expect_rotation(run(oscillator_problem<double>(system, duration), controlled(1e-13)), duration,
                    1e-12);
    expect_rotation(run(oscillator_problem<Extended>(system, duration), controlled(1e-22)),
                    duration, 1e-21);
  }
}

// Expected: the state of case SEED-10PI in reference_cases.json, and its degree 1 (the matrix's
// first column). Global errors of a controlled run are some multiple of the tolerance.
TEST(Fehlberg78, ErrorFallsWithTheToleranceOnThePapersOrbit) {
  const double state[] = {0.766193477722799312, -0.377383325619903653, -0.643494936008871042,
                          0.612704207756633850, 0.442268657796718223,  0.773489074513720723};
  const double column[] = {-82.9039186170813560, -60.9735264196907293, -106.657871345703589,
                           85.0485072235083642,  -42.0503868872173724, -71.9061898804517261};
  const DynamicalSystem system = paper_field();
  const auto problem = orbit<double>(system, 2, paper_time);
  double previous = 1;
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const FlowJet<double> jet = run(problem, controlled(tolerance));
    double error = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      error = std::max(error, std::abs(jet[c][0] - state[c]));
      error = std::max(error, std::abs(jet[c][1] - column[c]) / 106.7);
    }
    EXPECT_LE(error, 10 * tolerance);
    EXPECT_LE(error, previous / 20) << tolerance;
    previous = error;
  }
}

// Expected: the flow back over the same time undoes the flow: the nominal returns, and the map out
// of the new start composed with the map out is the identity (here its degree 1, a matrix product).
TEST(Fehlberg78, ForwardThenBackwardIsTheIdentity) {
  const DynamicalSystem system = paper_field();
  const FlowJet<double> out = run(orbit<double>(system, 1, 5), controlled(1e-13));
  FlowProblem<double> back = orbit<double>(system, 1, -5);
  for (std::size_t c = 0; c < 6; ++c) back.initial_state[c] = out[c][0];
  const FlowJet<double> home = run(back, controlled(1e-13));
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(home[i][0], orbit<double>(system, 1, 5).initial_state[i], 1e-11);
    for (std::size_t j = 0; j < 6; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k) sum += home[i][1 + k] * out[k][1 + j];
      EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-10);
    }
  }
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
      &system, SeriesSpace::create(1, 2), {4}, {1, 0, 0, 0, 1, 0}, Extended(2 * pi)};
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
  const DynamicalSystem system = paper_field();
  const FlowJet<double> plain = run(orbit<double>(system, 2, 1), fixed(0.05));
  const FlowJet<Extended> extended = run(orbit<Extended>(system, 2, 1), fixed(0.05));
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
  const auto problem = orbit<double>(system, 2, 0);
  for (const auto& settings : {fixed(0.1), controlled(1e-9)}) {
    const FlowJet<double> jet = integrate_fehlberg78(problem, settings, statistics);
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t k = 0; k < jet[c].size(); ++k) {
        const double expected = k == 0 ? problem.initial_state[c] : k == 1 + c ? 1 : 0;
        EXPECT_EQ(jet[c][k], expected);
      }
    }
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
        orbit<double>(system, 1, sign), fixed(0.3), statistics,
        [&](double time, const FlowJet<double>&) { times.push_back(time); });
    EXPECT_EQ(times, (std::vector<double>{sign * 0.25, sign * 0.5, sign * 0.75, sign}));
    EXPECT_EQ(statistics.steps, 4);
    EXPECT_EQ(statistics.rejected_steps, 0);
  }
}

TEST(Fehlberg78, TheObserverSeesEveryStepAndTheLastJet) {
  const DynamicalSystem system = paper_field();
  IntegrationStatistics statistics;
  long calls = 0;
  double last_time = 0;
  double last_value = 0;
  const FlowJet<double> jet =
      integrate_fehlberg78<double>(orbit<double>(system, 2, -3), controlled(1e-9), statistics,
                                   [&](double time, const FlowJet<double>& now) {
                                     EXPECT_LT(time, last_time);
                                     last_time = time;
                                     last_value = now[2][7];
                                     ++calls;
                                   });
  EXPECT_EQ(calls, statistics.steps);
  EXPECT_EQ(last_time, -3);
  EXPECT_EQ(last_value, jet[2][7]);
  // 13 stages a step; the first is shared by the repetitions of a step.
  EXPECT_LE(statistics.vector_field_evaluations,
            13 * statistics.steps + 12 * statistics.rejected_steps);
}

// A fall from rest at distance 1 meets the centre at pi / (2 sqrt 2) = 1.1107 (case RECT-1.0 in
// reference_cases.json); there is no answer behind it.
TEST(Fehlberg78, ACollisionIsAnError) {
  const DynamicalSystem system = kepler();
  FlowProblem<double> problem = orbit<double>(system, 2, 2);
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
  FlowProblem<double> problem = orbit<double>(system, 1, 0x1.1c28f5c28f5c3p+0);
  problem.initial_state = {1, 0, 0, 0, 0, 0};
  const FlowJet<double> jet = run(problem, controlled(1e-13));
  EXPECT_NEAR(jet[0][0], 0.0132362652092382376, 1e-10);
  EXPECT_NEAR(jet[0][1], 20.3439720109499775, 1e-7);
  EXPECT_EQ(jet[1][0], 0);
  EXPECT_EQ(jet[0][2], 0);
}

TEST(Fehlberg78, RefusesWrongInput) {
  const DynamicalSystem system = kepler();
  const auto problem = orbit<double>(system, 1, 1);
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
