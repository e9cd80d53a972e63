#include "hamjet/integrators/energy_conserving.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "energy_conserving_runs.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

using test::kepler_period;
using test::kepler_state;
using test::run_energy_conserving;
using Method = EnergyConservingMethod;

/// The largest error of the discrete energy over all steps, evaluated in extended precision, in
/// units in the last place of its terms |p|^2 and 1/r.
double discrete_error_in_last_places(const DynamicalSystem& kepler_system, Method method,
                                     const test::EnergyConservingRun<double>& run) {
  Extended first = 0;
  double largest = 0;
  for (const auto& step : run.steps) {
    const auto z =
        discrete_energy_point<Extended>(method, test::widened(step.start), test::widened(step.end));
    const Extended value = test::exact_energy(kepler_system, z);
    if (step.index == 0) first = value;
    const double p2 = static_cast<double>(Extended(z[3] * z[3] + z[4] * z[4] + z[5] * z[5]));
    const double r = static_cast<double>(sqrt(Extended(z[0] * z[0] + z[1] * z[1] + z[2] * z[2])));
    const double unit = 0x1p-52 * (p2 + 1 / r);
    largest = test::larger(largest, std::abs(static_cast<double>(Extended(value - first))) / unit);
  }
  return largest;
}

// Expected: the identity H(z_m) = E, to a few units in the last place of its terms, over thousands
// of steps and more than 20 revolutions at e = 0.6. H at the points themselves is not conserved.
TEST(EnergyConserving, MidpointKeepsItsEnergyOverTwentyRevolutions) {
  const DynamicalSystem system = kepler();
  const auto start = kepler_state(0.6, 0);
  const auto run = run_energy_conserving<double>(
      {system, Method::midpoint, start, 0.02, 21 * kepler_period(0.6)});
  ASSERT_FALSE(run.result.stop) << run.result.stop->message;
  EXPECT_GT(run.steps.size(), 6000U);
  EXPECT_GE(run.result.time, 21 * kepler_period(0.6));
  const double error = discrete_error_in_last_places(system, Method::midpoint, run);
  RecordProperty("units_in_the_last_place", std::to_string(error));
  EXPECT_LT(error, 8);
  double turned = 0;
  double worst = 0;
  for (const auto& step : run.steps) {
    turned += std::remainder(
        std::atan2(step.end[1], step.end[0]) - std::atan2(step.start[1], step.start[0]), 2 * M_PI);
    worst = std::max(worst, std::abs(test::energy(system, step.end) + 0.2));
  }
  EXPECT_GT(turned, 20 * 2 * M_PI);
  EXPECT_GT(worst, 1e-5);
}

// Expected: the identity H(q_k, p_(k+1)) = E. On a hyperbolic departure V has no extremum along the
// path, and the method runs on while the step size grows by three orders of magnitude.
TEST(EnergyConserving, StormerKeepsItsEnergyWhereThePotentialOnlyRises) {
  const DynamicalSystem system = kepler();
  for (const double duration : {1e4, -1e4}) {
    auto start = kepler_state(1.5, M_PI / 6);
    if (duration < 0) {
      for (std::size_t i = 3; i < 6; ++i) start[i] = -start[i];
    }
    const auto run =
        run_energy_conserving<double>({system, Method::stormer, start, 0.001, duration});
    ASSERT_FALSE(run.result.stop) << run.result.stop->message;
    EXPECT_GE(std::abs(run.result.time), 1e4);
    EXPECT_EQ(run.result.time < 0, duration < 0);
    EXPECT_GT(run.steps.size(), 10000U);
    EXPECT_GT(std::abs(run.steps.back().size), 1000 * std::abs(run.steps.front().size));
    const double error = discrete_error_in_last_places(system, Method::stormer, run);
    RecordProperty(duration > 0 ? "forwards" : "backwards", std::to_string(error));
    EXPECT_LT(error, 8);
  }
}

/// max / min of a positive quantity along a trajectory, minus 1.
template <class Quantity>
double variation(const test::EnergyConservingRun<double>& run, Quantity quantity) {
  double least = INFINITY;
  double most = 0;
  for (const auto& step : run.steps) {
    least = std::min(least, quantity(step));
    most = test::larger(most, quantity(step));
  }
  return most / least - 1;
}

// Expected: the leading order of the step equation, h G^(-1/3) constant with an error of order h^2,
// G in closed form (1 + r v^2 - 3 (q.p)^2 / r) / r^4.
TEST(EnergyConserving, MidpointStepsFollowTheInverseCubeRootOfG) {
  const DynamicalSystem system = kepler();
  std::vector<double> variations;
  for (const double step : {0.02, 0.01}) {
    const auto run = run_energy_conserving<double>(
        {system, Method::midpoint, kepler_state(0.6, 0), step, kepler_period(0.6)});
    variations.push_back(variation(run, [](const auto& s) {
      const auto z = discrete_energy_point(Method::midpoint, s.start, s.end);
      const double r = std::hypot(z[0], z[1]);
      const double v2 = z[3] * z[3] + z[4] * z[4];
      const double qp = z[0] * z[3] + z[1] * z[4];
      return s.size * std::cbrt((1 + r * v2 - 3 * qp * qp / r) / std::pow(r, 4));
    }));
    EXPECT_GT(variation(run, [](const auto& s) { return s.size; }), 6);
  }
  EXPECT_LT(variations[1], 1e-3);
  EXPECT_NEAR(variations[0] / variations[1], 4, 0.2);
}

// Expected: the leading order, h |dV/dt|^(1/2) constant with an error of order h; dV/dt = q.p/r^3.
TEST(EnergyConserving, StormerStepsFollowTheInverseRootOfTheRateOfThePotential) {
  const DynamicalSystem system = kepler();
  std::vector<double> variations;
  for (const double step : {0.002, 0.001}) {
    const auto run = run_energy_conserving<double>(
        {system, Method::stormer, kepler_state(1.5, M_PI / 6), step, 100});
    variations.push_back(variation(run, [](const auto& s) {
      const auto z = discrete_energy_point(Method::midpoint, s.start, s.end);
      const double r = std::hypot(z[0], z[1]);
      return s.size * std::sqrt((z[0] * z[3] + z[1] * z[4]) / (r * r * r));
    }));
    EXPECT_GT(variation(run, [](const auto& s) { return s.size; }), 20);
  }
  EXPECT_LT(variations[1], 0.02);
  EXPECT_NEAR(variations[0] / variations[1], 2, 0.2);
}

// Expected: G in closed form, above, and dV/dt = q.p/r^3; with masses p.V''p becomes
// p.M^-1 V'' M^-1 p, here k p^2/m^2 + k^2 q^2/m.
TEST(EnergyConserving, ConditionIsTheClosedForm) {
  const DynamicalSystem system = kepler();
  const auto z = kepler_state(0.85, 1.1);
  const double r = std::hypot(z[0], z[1]);
  const double v2 = z[3] * z[3] + z[4] * z[4];
  const double qp = z[0] * z[3] + z[1] * z[4];
  const double G = (1 + r * v2 - 3 * qp * qp / r) / std::pow(r, 4);
  EXPECT_NEAR(StepCondition<double>(system, Method::midpoint)(z), G, 1e-15);
  EXPECT_NEAR(StepCondition<double>(system, Method::stormer)(z), qp / (r * r * r), 1e-15);
  const DynamicalSystem oscillator = harmonic_oscillator(2.5, 0.7);
  EXPECT_NEAR(StepCondition<double>(oscillator, Method::midpoint)({0.3, -0.8}),
              0.7 * 0.64 / 6.25 + 0.49 * 0.09 / 2.5, 1e-16);
  EXPECT_NEAR(StepCondition<double>(oscillator, Method::stormer)({0.3, -0.8}),
              0.7 * 0.3 * -0.8 / 2.5, 1e-16);
}

/// Least-squares slope of log(error) against log(step).
double order_of(Method method, const std::vector<double>& start, double duration,
                const std::vector<double>& first_steps) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const double step : first_steps) {
    const DynamicalSystem system = kepler();
    const auto run = run_energy_conserving<double>({system, method, start, step, duration});
    EXPECT_FALSE(run.result.stop);
    const test::Flow<double> flow{system, start, run.result.time, 1, {}};
    const auto exact = test::final_state(test::run_gauss(flow));
    double error = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      error = test::larger(error, std::abs(run.result.state[i] - exact[i]));
    }
    EXPECT_GT(error, 1e-9);  // above the rounding floor
    const double x = std::log(step);
    const double y = std::log(error);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto count = static_cast<double>(first_steps.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

// Expected: order 2 for the symmetric midpoint form, order 1 for Störmer with p_k read at t_k; the
// error against the flow at the time reached, by Gauss with 8 stages.
TEST(EnergyConserving, Orders) {
  EXPECT_NEAR(order_of(Method::midpoint, kepler_state(0.6, 0), 24, {0.04, 0.02, 0.01, 0.005}), 2,
              0.05);
  EXPECT_NEAR(
      order_of(Method::stormer, kepler_state(1.5, M_PI / 6), 10, {0.004, 0.002, 0.001, 0.0005}), 1,
      0.05);
}

// Expected: the symmetry of the midpoint equations. From the end with p reversed and the last step
// size first, it returns to the start, in extended precision.
TEST(EnergyConserving, MidpointIsReversible) {
  const DynamicalSystem system = kepler();
  const auto there = test::take_steps<Extended>(
      {system, Method::midpoint, test::widened(kepler_state(0.6, 0)), Extended(0.05), 0}, 200);
  auto reversed = there.steps.back().end;
  for (std::size_t i = 3; i < 6; ++i) reversed[i] = -reversed[i];
  const auto back = test::take_steps<Extended>(
      {system, Method::midpoint, reversed, there.steps.back().size, 0}, 200);
  ASSERT_EQ(back.steps.size(), 200U);
  const auto& home = back.steps.back().end;
  const auto& start = there.steps.front().start;
  for (std::size_t i = 0; i < 6; ++i) {
    const Extended expected = i < 3 ? start[i] : Extended(-start[i]);
    EXPECT_LT(std::abs(static_cast<double>(Extended(home[i] - expected))), 1e-26);
  }
}

// Expected: the rule for arguments.
TEST(EnergyConserving, RefusesWhatIsWrong) {
  const DynamicalSystem system = kepler();
  const DynamicalSystem coupled =
      make_system("coupled", 1, [](auto q, auto p) { return q[0] * p[0] + p[0] * p[0]; });
  const auto fails = [](const EnergyConservingProblem<double>& problem, const char* text) {
    test::expect_error(ErrorKind::usage, text,
                       [&] { integrate_energy_conserving<double>(problem); });
  };
  const auto z = kepler_state(0.3, 0.5);
  fails({{}, Method::midpoint, z, 0.1, 1}, "no system");
  fails({system, Method::midpoint, {1, 0}, 0.1, 1}, "initial state");
  fails({system, Method::midpoint, z, 0, 1}, "first step");
  fails({system, Method::midpoint, z, -0.1, 1}, "first step");
  fails({system, Method::midpoint, z, NAN, 1}, "first step");
  fails({system, Method::midpoint, z, 0.1, INFINITY}, "duration");
  fails({system, Method::midpoint, {1, 0, 0, 0, NAN, 0}, 0.1, 1}, "not finite");
  fails({coupled, Method::stormer, {1, 1}, 0.1, 1}, "second-order form");
  EXPECT_FALSE(
      integrate_energy_conserving<double>({coupled, Method::midpoint, {1, 1}, 0.01, 0.1}).stop);
}

}  // namespace
}  // namespace hamjet
