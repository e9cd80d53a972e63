#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "energy_conserving_runs.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "integrators/small_systems.hpp"
#include "support/magnitude.hpp"

// Tests symplecticity, by differences in extended precision, and the equations in their corrected
// form.

namespace hamjet {
namespace {

using Method = EnergyConservingMethod;
using Vector = std::vector<Extended>;

constexpr std::size_t step_count = 5;

/// The discrete energy of the first step.
Extended first_energy(EnergyConservingProblem<Extended> problem) {
  problem.duration = problem.first_step / 2;
  return integrate_energy_conserving<Extended>(problem).energy;
}

/// The first step for which the discrete energy is E, by the secant method from the given step.
Extended first_step_for(EnergyConservingProblem<Extended> problem, const Extended& energy) {
  Extended before = problem.first_step;
  Extended error_before = first_energy(problem) - energy;
  Extended step = before * (1 + Extended(1e-8));
  for (int k = 0; k < 30; ++k) {
    problem.first_step = step;
    const Extended error = first_energy(problem) - energy;
    if (abs(error) < Extended(1e-32) * (1 + abs(energy))) break;  // a few roundings
    const Extended change = error * (step - before) / (error - error_before);
    before = step;
    error_before = error;
    step -= change;
  }
  return step;
}

/// End state, end time and energy of five steps, with their derivatives by the initial state; the
/// first step of every neighbour has the same size, or the same discrete energy.
struct Tangent {
  std::vector<Vector> state;  ///< [initial variable][component]
  Vector time;
  Vector energy;
};

Tangent tangent(EnergyConservingProblem<Extended> problem, bool is_energy_fixed) {
  const Extended delta("1e-10");
  const Extended energy = first_energy(problem);
  Tangent result;
  for (std::size_t j = 0; j < problem.initial_state.size(); ++j) {
    // Four points: the maps at one energy have third derivatives of 1e9 for small steps.
    Vector column(problem.initial_state.size(), Extended(0));
    Extended time = 0;
    Extended first_energies = 0;
    for (const int place : {-2, -1, 1, 2}) {
      const Extended weight = Extended(place == 2 || place == -2 ? -place / 2 : 8 * place) / 12;
      auto neighbour = problem;
      neighbour.initial_state[j] += place * delta;
      if (is_energy_fixed) neighbour.first_step = first_step_for(neighbour, energy);
      const auto run = test::take_steps(neighbour, step_count);
      EXPECT_EQ(run.steps.size(), step_count);
      const auto& last = run.steps.back();
      for (std::size_t i = 0; i < column.size(); ++i) column[i] += weight * last.end[i] / delta;
      time += weight * (last.time + last.size) / delta;
      first_energies += weight * first_energy(neighbour) / delta;
    }
    result.state.push_back(column);
    result.time.push_back(time);
    result.energy.push_back(first_energies);
  }
  return result;
}

/// The largest entry of S^T J S - J, and with `is_extended` of the two-form dq ^ dp - dt ^ dE.
double defect(const Tangent& t, bool is_extended) {
  const std::size_t n = t.state.size() / 2;
  double largest = 0;
  for (std::size_t a = 0; a < 2 * n; ++a) {
    for (std::size_t b = 0; b < 2 * n; ++b) {
      Extended form = a + n == b ? -1 : (b + n == a ? 1 : 0);
      for (std::size_t i = 0; i < n; ++i) {
        form += t.state[a][i] * t.state[b][n + i] - t.state[a][n + i] * t.state[b][i];
      }
      if (is_extended) form -= t.time[a] * t.energy[b] - t.energy[a] * t.time[b];
      largest = test::larger(largest, std::abs(static_cast<double>(form)));
    }
  }
  return largest;
}

/// The system is not separable, so that it has no second-order structure.
DynamicalSystem coupled_momenta() {
  return make_system("coupled momenta", 2, [](auto q, auto p) {
    return (p[0] * p[0] + p[1] * p[1]) * (1 + q[0] * q[0] / 4) / 2 + square(q[0] + q[1]) +
           square(q[1]) + q[0] * p[1] / 3;
  });
}

// Expected: S^T J S = J for the Jacobian S of five steps with respect to the initial state, where
// the first steps of the neighbours have the same discrete energy; not where they have the same
// size, but then dq ^ dp - dt ^ dE is preserved (lemmas after eqs. `m_h_stormer`, `m_h_midpoint`).
TEST(EnergyConservingSymplectic, AtOneEnergyAndNoOther) {
  const SharedSystem masses = test::coupled_masses();
  const struct {
    SharedSystem system;
    Method method;
    Vector start;
  } cases[] = {
      {masses, Method::stormer, {0.9, 0.6, 3, 2}},
      {masses, Method::midpoint, {0.9, 0.6, 3, 2}},
      {coupled_momenta(), Method::midpoint, {0.4, -0.7, 0.5, 0.3}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.system->name + " " +
                 std::string(energy_conserving_method_names()[static_cast<std::size_t>(c.method)]));
    const EnergyConservingProblem<Extended> problem{c.system, c.method, c.start, Extended(0.03125),
                                                    1};
    const Tangent one_energy = tangent(problem, true);
    const Tangent own_energies = tangent(problem, false);
    RecordProperty(c.system->name + (c.method == Method::stormer ? "_stormer" : "_midpoint"),
                   fmt::format("{:.2g} at one energy, {:.2g} at their own, {:.2g} with dt ^ dE",
                               defect(one_energy, false), defect(own_energies, false),
                               defect(own_energies, true)));
    EXPECT_LT(defect(one_energy, false), 1e-15);
    EXPECT_GT(defect(own_energies, false), 1e-3);
    EXPECT_LT(defect(own_energies, true), 1e-15);
  }
}

// Expected: the same two lemmas on the four systems on which every integrator is tested.
TEST(EnergyConservingSymplectic, OnTheOscillatorTheDoubleWellKeplerAndTheEarthOrbit) {
  const DynamicalSystem systems[] = {
      harmonic_oscillator(1, 1), double_well(), kepler(),
      zonal_gravity(
          {1.0, 0x1.d283e1c01dcf3p-1, {{2, 0x1.1bcdd8a6cfd70p-10}, {3, 0x1.53e5d6a0f845cp-19}}})};
  const std::vector<double> inclined = {0.4, 0.7, 0.5, -0.8, 0.5, 0.6};  // outbound, bound
  const Vector starts[] = {{0.9, 0.6},
                           {0.8, 0.3},
                           {inclined.begin(), inclined.end()},
                           {inclined.begin(), inclined.end()}};
  for (std::size_t k = 0; k < std::size(systems); ++k) {
    for (const Method method : {Method::stormer, Method::midpoint}) {
      SCOPED_TRACE(systems[k].name + " " +
                   std::string(energy_conserving_method_names()[static_cast<std::size_t>(method)]));
      const EnergyConservingProblem<Extended> problem{systems[k], method, starts[k],
                                                      Extended(0.03125), 1};
      const Tangent own_energies = tangent(problem, false);
      EXPECT_LT(defect(tangent(problem, true), false), 1e-15);
      // On the oscillator all steps of the midpoint form are equal, whatever the energy.
      if (k > 0 || method == Method::stormer) {
        EXPECT_GT(defect(own_energies, false), 1e-6);
      }
      EXPECT_LT(defect(own_energies, true), 1e-15);
    }
  }
}

/// An oscillator whose mass is not 1, with 20 steps of a method: errata are pinned where M matters.
constexpr double mass = 2.5;
constexpr double stiffness = 0.7;

test::EnergyConservingRun<double> oscillator_run(Method method) {
  static const DynamicalSystem system = harmonic_oscillator(mass, stiffness);
  return test::take_steps<double>({system, method, {1.2, -0.9}, 0.02, 0}, 20);
}

/// e_(k+1) = -(M (dq/dt)^2 / 2 + V(q_k)) of a step, from positions and times alone.
double stormer_energy(double q, double next, double size) {
  const double velocity = (next - q) / size;
  return -(mass * velocity * velocity + stiffness * q * q) / 2;
}

// Expected: the identity e_(k+1) - e_k = 0 of `m_l_stormer`, line 1 corrected, from positions and
// times alone. As printed, e_k - e_(k-1) = 0, the last time does not occur: a last step of another
// size, which satisfies line 2, satisfies the printed line 1 too.
TEST(EnergyConservingErrata, StormerLagrangianEnergyNamesTheNewTime) {
  const auto run = oscillator_run(Method::stormer);
  ASSERT_EQ(run.steps.size(), 20U);
  const auto e = [](const EnergyConservingStep<double>& s) {
    return stormer_energy(s.start[0], s.end[0], s.size);
  };
  for (std::size_t k = 1; k < run.steps.size(); ++k) {
    EXPECT_NEAR(e(run.steps[k]), e(run.steps[k - 1]), 1e-13);
  }
  const auto& last = run.steps.back();
  const double other = 1.5 * last.size;
  const double p = last.start[1] - other * stiffness * last.start[0];
  const double wrong = stormer_energy(last.start[0], last.start[0] + other * p / mass, other);
  EXPECT_GT(std::abs(wrong - e(run.steps[18])), 1e-3);     // the correct line rejects the step
  EXPECT_NEAR(e(run.steps[18]), e(run.steps[17]), 1e-13);  // the printed line holds nevertheless
}

// Expected: Delta q = Delta t M^-1 p_(k+1) and Delta p = -Delta t grad V(q_k) of `m_h_stormer`, the
// lost M^-1 restored, and line 2 of `m_l_stormer`.
TEST(EnergyConservingErrata, StormerHamiltonianKeepsTheMass) {
  const auto run = oscillator_run(Method::stormer);
  for (const auto& s : run.steps) {
    const double dq = s.end[0] - s.start[0];
    EXPECT_NEAR(dq, s.size * s.end[1] / mass, 1e-15);
    EXPECT_GT(std::abs(dq - s.size * s.end[1]), 1e-3);
    EXPECT_NEAR(s.end[1] - s.start[1], -s.size * stiffness * s.start[0], 1e-15);
  }
  for (std::size_t k = 1; k < run.steps.size(); ++k) {
    const auto& s = run.steps[k];
    const auto& before = run.steps[k - 1];
    const double change = mass * (s.end[0] - s.start[0]) / s.size -
                          mass * (before.end[0] - before.start[0]) / before.size;
    EXPECT_NEAR(change, -s.size * stiffness * s.start[0], 1e-13);
  }
}

// Expected: (p_(k+1) + p_k)/2 = D2 L_d = M Delta q / Delta t of `m_l_midpoint`, line 3 corrected;
// the printed factor Delta t / tau, with the first step for tau, is wrong. Lines 1 and 4 as
// printed.
TEST(EnergyConservingErrata, MidpointMomentumHasNoFactor) {
  static const DynamicalSystem system = double_well();
  const auto run = test::take_steps<double>({system, Method::midpoint, {0.95, 0.1}, 0.05, 0}, 20);
  ASSERT_EQ(run.steps.size(), 20U);
  const double tau = run.steps.front().size;
  double largest_factor = 1;
  for (const auto& s : run.steps) {
    const double q = (s.start[0] + s.end[0]) / 2;
    const double p = (s.start[1] + s.end[1]) / 2;
    const double velocity = (s.end[0] - s.start[0]) / s.size;
    EXPECT_NEAR(p, velocity, 1e-13);
    EXPECT_NEAR(s.end[1] - s.start[1], -s.size * (2 * q * q * q - q), 1e-15);
    EXPECT_NEAR(-(velocity * velocity + q * q * q * q - q * q) / 2,
                -test::energy<double>(system, {q, p}), 1e-13);
    if (std::abs(s.size / tau - 1) > 0.1) {
      EXPECT_GT(std::abs(p - s.size / tau * velocity), 0.05 * std::abs(velocity));
    }
    largest_factor = std::max(largest_factor, s.size / tau);
  }
  EXPECT_GT(largest_factor, 1.2);  // shows that the factor differs from 1
}

}  // namespace
}  // namespace hamjet
