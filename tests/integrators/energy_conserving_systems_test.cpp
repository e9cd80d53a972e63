#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "energy_conserving_runs.hpp"
#include "support/convergence.hpp"
#include "support/magnitude.hpp"

// Both energy-conserving methods on every system of the paper, on spans on which the step equation
// has a root: order, energy and way back. If it has no root, the integration stops:
// energy_conserving_stop_test, and for what is asked of whole revolutions the end of this file.
//
// Midpoint runs wherever G = p.V'' p + g.g (g = grad V) keeps its sign: for ever on the oscillator
// (G is constant), below the barrier of the double well, on Kepler's problem with e < sqrt(5/8), on
// the paper's orbit; above the barrier until G turns negative near its top. Störmer runs from one
// extremum of V along the path to the next: a quarter of a period of the oscillator, the way down
// or up one side of a well, the way from perigee to apogee.

namespace hamjet {
namespace {

using test::kepler_state;
using test::run_energy_conserving;
using test::take_steps;
using test::widened;
using Cause = EnergyConservingStopCause;
using Method = EnergyConservingMethod;

struct Case {
  std::string name;
  DynamicalSystem system;
  Method method;
  std::vector<double> start;
  double first_step;  ///< the largest step of the fit
  double duration;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

DynamicalSystem earth() { return zonal_gravity(test::paper_orbit().field); }

/// The paper's orbit a time unit after perigee, a tenth of a revolution.
std::vector<double> after_perigee() {
  const test::Flow<double> flow{earth(), test::paper_orbit().start, 1, 0, {}};
  return test::final_state(test::run_gauss(flow));
}

std::vector<Case> cases() {
  constexpr Method midpoint = Method::midpoint;
  constexpr Method stormer = Method::stormer;
  return {
      {"MidpointOscillator", harmonic_oscillator(), midpoint, {0.3, -0.8}, 0.04, 2 * M_PI},
      {"MidpointDoubleWell", double_well(), midpoint, {0.99, 0}, 0.02, 6},
      {"MidpointDoubleWellAboveBarrier", double_well(), midpoint, {1, 0.05}, 0.02, 2},
      {"MidpointKepler", kepler(), midpoint, kepler_state(0.6, 0), 0.02, 12},
      {"MidpointEarthOrbit", earth(), midpoint, test::paper_orbit().start, 0.04, 10.7},
      {"StormerOscillatorRising", harmonic_oscillator(), stormer, {0.3, 0.8}, 0.004, 0.8},
      {"StormerOscillatorFalling", harmonic_oscillator(), stormer, {0.8, -0.3}, 0.004, 0.8},
      {"StormerDoubleWellRising", double_well(), stormer, {0.8, 0.3}, 0.004, 0.3},
      {"StormerDoubleWellFalling", double_well(), stormer, {0.3, 0.3}, 0.004, 0.6},
      {"StormerKepler", kepler(), stormer, kepler_state(0.6, 0.5), 0.004, 3},
      {"StormerEarthOrbit", earth(), stormer, after_perigee(), 0.004, 2},
  };
}

/// The magnitudes of |p|^2 / 2 and of the potential's terms, which determine the rounding of H.
template <class Real>
Real energy_terms(const DynamicalSystem& system, const std::vector<Real>& z) {
  using std::abs;
  const std::size_t n = system.degrees_of_freedom;
  Real kinetic = 0;
  for (std::size_t i = n; i < 2 * n; ++i) kinetic += z[i] * z[i] / 2;
  const Real potential = test::energy<Real>(system, z) - kinetic;
  if (system.name != "double-well") return kinetic + abs(potential);
  return kinetic + z[0] * z[0] / 2 + z[0] * z[0] * z[0] * z[0] / 2;  // q^4/2 and -q^2/2 cancel
}

template <class Real>
double distance(const std::vector<Real>& a, const std::vector<Real>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = test::larger(largest, std::abs(static_cast<double>(Real(a[i] - b[i]))));
  }
  return largest;
}

class EnergyConservingSystems : public ::testing::TestWithParam<Case> {
 protected:
  EnergyConservingProblem<Extended> extended_problem(double first_step) const {
    const Case& one = GetParam();
    return {one.system, one.method, widened(one.start), Extended(first_step), one.duration};
  }
  std::vector<double> first_steps() const {
    const double largest = GetParam().first_step;
    return {largest, largest / 2, largest / 4, largest / 8};
  }
};

// Expected: the identity H(z_m) = E or H(q_k, p_(k+1)) = E to a few units in the last place of H's
// terms, here or in the first step, which E comes from; in every step, twenty times the duration
// long where no stop is ahead.
TEST_P(EnergyConservingSystems, Energy) {
  const Case& one = GetParam();
  const bool is_endless =
      one.method == Method::midpoint && one.name != "MidpointDoubleWellAboveBarrier";
  const auto run = run_energy_conserving<double>(
      {one.system, one.method, one.start, one.first_step, one.duration * (is_endless ? 20 : 1)});
  ASSERT_FALSE(run.result.stop) << run.result.stop->message;
  EXPECT_GT(run.steps.size(), is_endless ? 1500U : 60U);
  Extended first = 0;
  Extended first_terms = 0;
  double worst = 0;
  for (const auto& step : run.steps) {
    const auto z =
        discrete_energy_point<Extended>(one.method, widened(step.start), widened(step.end));
    const Extended value = test::exact_energy(one.system, z);
    const Extended terms = energy_terms(one.system, z);
    if (step.index == 0) {
      first = value;
      first_terms = terms;
    }
    const Extended error = (value - first) / std::max(terms, first_terms);
    worst = test::larger(worst, std::abs(static_cast<double>(error)));
  }
  RecordProperty("units_in_the_last_place", fmt::format("{:.2g}", worst / 0x1p-52));
  EXPECT_LT(worst, 8 * 0x1p-52);
}

// Expected: order 2 for the symmetric midpoint form, order 1 for Störmer with p_k read at t_k,
// against 12 stages of Gauss at the time reached. In extended precision, so that no round-off is in
// the fit; the smallest error is recorded. The next term of the error is of relative size h
// (Störmer) or h^2.
TEST_P(EnergyConservingSystems, Order) {
  const Case& one = GetParam();
  std::vector<double> errors;
  for (const double first_step : first_steps()) {
    const auto result = integrate_energy_conserving<Extended>(extended_problem(first_step));
    ASSERT_FALSE(result.stop) << result.stop->message;
    const test::Flow<Extended> flow{one.system, widened(one.start), result.time, 0, {}};
    const auto exact = test::final_state(test::run_gauss(flow, test::adaptive(12, 1e-20)));
    errors.push_back(distance(result.state, exact));
  }
  const double order = test::fitted_order(first_steps(), errors);
  RecordProperty("order", fmt::format("{:.4f}, least error {:.2g}", order, errors.back()));
  EXPECT_NEAR(order, one.method == Method::midpoint ? 2 : 1, 0.03);
}

// Expected: the symmetry of the midpoint equations: as many steps back in time, the first of the
// size of the last one there, lead to the start. Round-off of a step moves H by about epsilon times
// its terms T, and with it all later step sizes, h^2 = 8 (H(z_k) - E) / G, by 4 epsilon T / (h G);
// over 2 n steps the state is out by (2 n)^2 / 2 times this times |z'|. Störmer's equations are not
// symmetric: reversed, they are those of the method that evaluates V' at q_(k+1), so that the
// distance is an error of order 1 like any other.
TEST_P(EnergyConservingSystems, TimeReversibility) {
  const Case& one = GetParam();
  const bool is_symmetric = one.method == Method::midpoint;
  std::vector<double> distances;
  for (const double first_step : first_steps()) {
    const auto there = run_energy_conserving<Extended>(extended_problem(first_step));
    ASSERT_FALSE(there.result.stop) << there.result.stop->message;
    auto problem = extended_problem(first_step);
    problem.initial_state = there.result.state;
    problem.first_step = there.result.last_step;
    const auto back = take_steps<Extended>(problem, there.steps.size(), -1);
    ASSERT_EQ(back.steps.size(), there.steps.size());
    EXPECT_LT(back.steps.front().size, 0);
    distances.push_back(distance(back.steps.back().end, there.steps.front().start));
    if (!is_symmetric) continue;
    double largest_move = 0;
    for (const auto& step : there.steps) {
      const double h = static_cast<double>(step.size);
      const double velocity = distance(step.end, step.start) / h;
      const double terms = static_cast<double>(energy_terms(one.system, step.start));
      const double condition = static_cast<double>(step.condition);
      largest_move = std::max(largest_move, 4 * terms * velocity / (h * condition));
    }
    const auto count = static_cast<double>(2 * there.steps.size());
    const auto epsilon = static_cast<double>(std::numeric_limits<Extended>::epsilon());
    const double bound = epsilon * largest_move * count * count / 2;
    EXPECT_LT(distances.back(), bound) << first_step;
    EXPECT_LT(bound, 1e-18);  // the bound is far below any error of the method
    RecordProperty("distance_back", fmt::format("{:.2g} of {:.2g}", distances.back(), bound));
  }
  if (is_symmetric) return;
  const double order = test::fitted_order(first_steps(), distances);
  RecordProperty("order_of_distance_back", fmt::format("{:.4f}, {:.2g} to {:.2g}", order,
                                                       distances.front(), distances.back()));
  EXPECT_NEAR(order, 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(All, EnergyConservingSystems, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

// Expected: the midpoint rule turns the oscillator by 2 arctan(h/2), so that G = q^2 + p^2 is the
// same in every step, all steps are of one size h, and n of them turn the start by 2 n arctan(h/2).
// In extended precision, with the round-off of TimeReversibility for H's terms T = G/2: n steps
// move the step size by 2 n epsilon / h and the state, whose velocity is below 1, by n^2 epsilon /
// h.
TEST(EnergyConservingOscillator, MidpointTurnsInEqualSteps) {
  const DynamicalSystem system = harmonic_oscillator();
  constexpr std::size_t count = 1000;
  const auto n = static_cast<double>(count);
  const Extended h = Extended(1) / 16;
  const auto epsilon = static_cast<double>(std::numeric_limits<Extended>::epsilon());
  const auto start = widened({0.3, -0.8});
  const auto run = take_steps<Extended>({system, Method::midpoint, start, h, 0}, count);
  ASSERT_EQ(run.steps.size(), count);
  double size_error = 0;
  double state_error = 0;
  for (const auto& step : run.steps) {
    const Extended angle = 2 * (step.index + 1) * atan(Extended(h / 2));
    const std::vector<Extended> exact = {start[0] * cos(angle) + start[1] * sin(angle),
                                         start[1] * cos(angle) - start[0] * sin(angle)};
    size_error = test::larger(size_error, std::abs(static_cast<double>(Extended(step.size - h))));
    state_error = test::larger(state_error, distance(step.end, exact));
  }
  RecordProperty("errors", fmt::format("{:.2g} (size), {:.2g}", size_error, state_error));
  EXPECT_LT(size_error, 2 * n * epsilon * 16);
  EXPECT_LT(state_error, n * n * epsilon * 16);
}

/// Expects the one line of a numerical error: step, time and condition.
void expect_refusal(const Case& one, const EnergyConservingResult<double>& result) {
  ASSERT_TRUE(result.stop);
  const std::string& message = result.stop->message;
  const std::string head =
      fmt::format("energy-conserving stormer: step {} at t = {:.10g}: ", result.steps, result.time);
  EXPECT_EQ(message.rfind(head, 0), 0U) << one.name << ": " << message;
  EXPECT_NE(message.find(fmt::format("dV/dt is {:.6g} here", result.stop->condition)),
            std::string::npos)
      << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

// Expected: with x the steps to the place where dV/dt changes sign, to leading order. Before a
// maximum of V no root where |s^2 x - 1| < s (energy_conserving.hpp); at a turning point in one
// dimension d^2V/dt^2 = -g^2, so that s = 1 and 0 < x < 2. At the bottom of a well V grows with the
// square of the time from it, the root is 1 + 1/(2 x) last steps: more than 2 of them below x =
// 1/2, less than 1/2 (or against time) above x = -1, and from x >= 1/2 no step leads beyond x = -1.
TEST(EnergyConservingRefusals, StormerAtTheEndsOfItsSpans) {
  const struct {
    Case problem;
    bool is_maximum;
  } spans[] = {
      {{"oscillator, rising", harmonic_oscillator(), Method::stormer, {0.3, 0.8}, 0, 7}, true},
      {{"oscillator, falling", harmonic_oscillator(), Method::stormer, {0.8, -0.3}, 0, 7}, false},
      {{"double well, rising", double_well(), Method::stormer, {0.8, 0.3}, 0, 7}, true},
      {{"double well, falling", double_well(), Method::stormer, {0.3, 0.3}, 0, 7}, false},
      {{"double well, falling back", double_well(), Method::stormer, {0.95, -0.2}, 0, 7}, false},
  };
  for (const auto& [one, is_maximum] : spans) {
    for (const double first_step : {0.002, 0.001, 0.0005, 0.00025}) {
      SCOPED_TRACE(one.name + fmt::format(" {}", first_step));
      const auto result = integrate_energy_conserving<double>(
          {one.system, one.method, one.start, first_step, one.duration});
      expect_refusal(one, result);
      ASSERT_TRUE(result.stop && result.stop->steps_to_sign_change);
      const double place = *result.stop->steps_to_sign_change;
      if (is_maximum) {
        EXPECT_EQ(result.stop->cause, Cause::no_root);
        EXPECT_GT(place, 0);
        EXPECT_LT(place, 2);
      } else {
        EXPECT_TRUE(result.stop->cause == Cause::reversed_root ||
                    result.stop->cause == Cause::step_change);
        EXPECT_GT(place, -1);
        EXPECT_LT(place, 0.5);
      }
    }
  }
}

// Expected: on the paper's orbit no whole revolution: from perigee, a minimum of V, not even two
// steps; from a later place until s^2 x is within s of 1 before apogee, where s^2 = e = 0.3 of the
// Kepler orbit (the oblateness changes it by about 1e-3).
TEST(EnergyConservingRefusals, StormerOnTheOrbitOfThePaper) {
  const Case from_perigee{"perigee", earth(), Method::stormer, test::paper_orbit().start, 0, 10.7};
  const Case later{"later", earth(), Method::stormer, after_perigee(), 0, 10.7};
  for (const double first_step : {0.002, 0.001, 0.0005}) {
    const auto none = integrate_energy_conserving<double>(
        {from_perigee.system, Method::stormer, from_perigee.start, first_step, 10.7});
    expect_refusal(from_perigee, none);
    ASSERT_TRUE(none.stop);
    EXPECT_EQ(none.steps, 1);
    EXPECT_EQ(none.stop->cause, Cause::reversed_root);
    const auto part = integrate_energy_conserving<double>(
        {later.system, Method::stormer, later.start, first_step, 10.7});
    expect_refusal(later, part);
    ASSERT_TRUE(part.stop && part.stop->steps_to_sign_change);
    EXPECT_EQ(part.stop->cause, Cause::no_root);
    EXPECT_GT(*part.stop->steps_to_sign_change, 0.95 * (1 - std::sqrt(0.3)) / 0.3);
    EXPECT_LT(*part.stop->steps_to_sign_change, 1.05 * (1 + std::sqrt(0.3)) / 0.3);
  }
}

}  // namespace
}  // namespace hamjet
