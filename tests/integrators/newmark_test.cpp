#include "hamjet/integrators/newmark.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "integrator_checks.hpp"
#include "integrators/small_systems.hpp"
#include "support/convergence.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

template <class Real>
FlowJet<Real> newmark(const FlowProblem<Real>& problem, double beta, double step,
                      IntegrationStatistics* statistics = nullptr) {
  IntegrationStatistics own;
  return integrate_newmark(problem, {.beta = beta, .step = step},
                           statistics != nullptr ? *statistics : own);
}

/// a = M^-1 F(q) on series.
template <class Real>
std::vector<Series<Real>> acceleration(const DynamicalSystem& system,
                                       const std::vector<Series<Real>>& q) {
  const auto force = evaluate_on_series<Real>(system.second_order->force, q);
  std::vector<Series<Real>> result;
  for (std::size_t i = 0; i < q.size(); ++i) {
    Series<Real> sum(q[0].space_pointer());
    for (std::size_t j = 0; j < q.size(); ++j) {
      sum += convert<Real>(system.second_order->inverse_mass[i * q.size() + j]) * force[j];
    }
    result.push_back(sum);
  }
  return result;
}

template <class Real>
std::vector<Series<Real>> positions(const FlowJet<Real>& jet) {
  return {jet.begin(), jet.begin() + static_cast<std::ptrdiff_t>(jet.size() / 2)};
}

// Expected: with w = k/m, q_+ (1 + beta h^2 w) = q (1 - (1/2 - beta) h^2 w) + h p/m and
// p_+ = p - h k (q + q_+)/2, in extended precision; the last case is stiff, h^2 w = 1e6.
template <class Real>
void expect_oscillator(double beta, double stiffness, int direction, double tolerance) {
  const int n = 64;
  const test::Flow<Real> flow{
      harmonic_oscillator(2.5, stiffness), {Real(0.3), Real(-0.8)}, Real(direction * n) / 8, 3, {}};
  const auto jet = newmark(test::problem_of(flow), beta, 0.125);
  const Extended h = Extended(direction) / 8;
  const Extended m = 2.5;
  const Extended k = stiffness;
  const Extended b = beta;
  Extended q[3] = {0.3, 1, 0};
  Extended p[3] = {-0.8, 0, 1};
  for (int step = 0; step < n; ++step) {
    for (int c = 0; c < 3; ++c) {
      const Extended before = q[c];
      q[c] = (q[c] * (1 - (Extended(0.5) - b) * h * h * k / m) + h * p[c] / m) /
             (1 + b * h * h * k / m);
      p[c] -= h * k * (before + q[c]) / 2;
    }
  }
  const double momentum_scale = 1 + std::sqrt(stiffness * 2.5);
  for (std::size_t c = 0; c < 3; ++c) {
    const double scale = c == 2 ? 1 : momentum_scale;
    EXPECT_NEAR(static_cast<double>(Extended(Extended(jet[0][c]) - q[c])), 0, tolerance)
        << beta << " " << stiffness;
    EXPECT_NEAR(static_cast<double>(Extended(Extended(jet[1][c]) - p[c])) / scale, 0, tolerance)
        << beta << " " << stiffness;
  }
  for (std::size_t c = 3; c < jet[0].size(); ++c) EXPECT_EQ(jet[0][c], 0);
}

TEST(Newmark, IsTheDiscreteOscillatorWithItsMass) {
  for (const double beta : {0.0, 0.1, 0.25, 0.5}) {
    for (const int direction : {1, -1}) {
      expect_oscillator<double>(beta, 0.7, direction, 2e-14);
      expect_oscillator<Extended>(beta, 0.7, direction, 2e-32);
    }
  }
  // Unconditionally stable from beta = 1/4 on. A kick h k q is omega h = 1000 times the momentum,
  // and its rounding is what is left: a few times 64 steps x 1000 x 2^-52.
  for (const double beta : {0.25, 0.5}) expect_oscillator<double>(beta, 1.6e8, 1, 2e-10);
}

// Expected: a constant force is integrated exactly, q = q0 + p0 t - 3 t^2/2; and with F = q, beta =
// 1/4, h = 1: q_+ = (5/4 q + p)/(3/4), p_+ = p + (q + q_+)/2.
TEST(Newmark, TakesForcesThatAreConstantOrTheCoordinateItself) {
  const auto fall =
      make_system("fall", 1, [](auto q, auto p) { return p[0] * p[0] / 2 + 3 * q[0]; });
  const test::Flow<double> falling{fall, {1, 0.5}, 2, 2, {}};
  const auto end = newmark(test::problem_of(falling), 0.25, 0.25);
  const double expected[2][3] = {{-4, 1, 2}, {-5.5, 0, 1}};
  const auto repulsion =
      make_system("repulsion", 1, [](auto q, auto p) { return p[0] * p[0] / 2 - q[0] * q[0] / 2; });
  const test::Flow<double> repelled{repulsion, {1, 0}, 1, 1, {}};
  const auto one = newmark(test::problem_of(repelled), 0.25, 1);
  const double matrix[2][3] = {{5.0 / 3, 5.0 / 3, 4.0 / 3}, {4.0 / 3, 4.0 / 3, 5.0 / 3}};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(end[i][k], expected[i][k], 1e-14);
      EXPECT_NEAR(one[i][k], matrix[i][k], 1e-15);
    }
  }
}

TEST(Newmark, WithoutBetaIsVelocityVerlet) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  flow.duration = 3;
  const auto problem = test::problem_of(flow);
  IntegrationStatistics statistics;
  const auto expected = integrate_velocity_verlet(problem, {.step = 0.1}, statistics);
  const auto jet = newmark(problem, 0, 0.1);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < jet[i].size(); ++k) EXPECT_EQ(jet[i][k], expected[i][k]);
  }
  // The implicit method converges to this value.
  const auto near = newmark(problem, 1e-14, 0.1);
  for (int d = 0; d <= 3; ++d) EXPECT_LE(test::relative_error(near, expected, d), 1e-12);
}

/// The jets at the start and after every step.
template <class Real>
std::vector<FlowJet<Real>> all_jets(const FlowProblem<Real>& problem, double beta, double step) {
  std::vector<FlowJet<Real>> jets{starting_jet(problem)};
  IntegrationStatistics statistics;
  integrate_newmark<Real>(problem, {.beta = beta, .step = step}, statistics,
                          [&](const Real&, const FlowJet<Real>& jet) { jets.push_back(jet); });
  return jets;
}

// Expected: the formulas of the method in (q, v), put in after the fact, on series; p = M v.
TEST(Newmark, EveryStepFulfilsTheFormulasOnSeries) {
  const test::Flow<double> flow{test::coupled_masses(), {0.3, -0.2, 0.5, 0.1}, 1, 4, {}};
  const double w[2][2] = {{2, 0.5}, {0.5, 4}};
  const double h = 0.125;
  for (const double beta : {0.1, 0.25, 0.5}) {
    const auto jets = all_jets(test::problem_of(flow), beta, h);
    ASSERT_EQ(jets.size(), 9u);
    for (std::size_t k = 0; k + 1 < jets.size(); ++k) {
      const auto a = acceleration(flow.system, positions(jets[k]));
      const auto b = acceleration(flow.system, positions(jets[k + 1]));
      for (std::size_t i = 0; i < 2; ++i) {
        const auto velocity = [&](const FlowJet<double>& jet) {
          return w[i][0] * jet[2] + w[i][1] * jet[3];
        };
        const auto v = velocity(jets[k]);
        const auto q = jets[k][i] + h * v + h * h * ((0.5 - beta) * a[i] + beta * b[i]);
        EXPECT_LE(test::largest_coefficient(jets[k + 1][i] - q),
                  1e-14 * (1 + test::largest_coefficient(q)));
        const auto v_end = v + h / 2 * (a[i] + b[i]);
        EXPECT_LE(test::largest_coefficient(velocity(jets[k + 1]) - v_end),
                  1e-14 * (1 + test::largest_coefficient(v_end)));
      }
    }
  }
}

// Expected: q_(k+1) - 2 q_k + q_(k-1) = h^2 (beta a_(k+1) + (1 - 2 beta) a_k + beta a_(k-1)); the
// indices that the paper prints, shifted by one in two of the terms, miss by more than h^3/10.
TEST(Newmark, TwoStepFormHoldsWithTheCorrectedIndices) {
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  flow.duration = 1;
  const Extended h = Extended(1) / 8;
  for (const double beta : {0.125, 0.25, 0.5}) {
    const auto jets = all_jets(test::problem_of(flow), beta, 0.125);
    ASSERT_EQ(jets.size(), 9u);
    const auto a = [&](std::size_t k) { return acceleration(flow.system, positions(jets[k])); };
    for (std::size_t k = 1; k + 2 < jets.size(); ++k) {
      const auto before = a(k - 1);
      const auto now = a(k);
      const auto after = a(k + 1);
      const auto later = a(k + 2);
      double right = 0;
      double printed = 0;
      const Extended b = beta;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto second = jets[k + 1][i] - Extended(2) * jets[k][i] + jets[k - 1][i];
        const auto corrected =
            h * h * (b * after[i] + Extended(1 - 2 * b) * now[i] + b * before[i]);
        const auto shifted =
            h * h * (b * later[i] + Extended(1 - 2 * b) * after[i] + b * before[i]);
        right = test::larger(right, test::largest_coefficient(second - corrected));
        printed = std::max(printed, test::largest_coefficient(second - shifted));
      }
      EXPECT_LE(right, 1e-31);
      EXPECT_GE(printed, 2e-4);
    }
  }
}

// Expected: order 2 of the nominal and of the coefficients of degree 1 and 2.
TEST(Newmark, OrderOfConvergenceIsTwo) {
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.duration = 2;
  const auto expected = test::run_gauss(flow, test::adaptive(8, 1e-18));
  for (const double beta : {0.25, 0.5}) {
    const auto [steps, errors] = test::convergence(
        flow, expected, {200, 400, 800, 1600},
        [&](const auto& problem, double step) { return newmark(problem, beta, step); });
    for (const auto& error : errors) {
      EXPECT_NEAR(test::fitted_order(steps, error), 2, 0.03) << beta;
      EXPECT_GT(error.back(), 1e-9);
      EXPECT_LT(error.back(), 1e-4);
    }
  }
}

/// (q, p) -> (q - c a(q), p) about a state, on series in the deviations from it.
template <class Real>
FlowJet<Real> discrete_variables(const FlowJet<Real>& jet, const DynamicalSystem& system,
                                 const Real& c) {
  FlowJet<Real> result = jet;
  const auto a = acceleration(system, positions(jet));
  for (std::size_t i = 0; i < a.size(); ++i) result[i] -= c * a[i];
  return result;
}

/// The jet of the map (q^d, p) -> (q^d, p), from the one in (q, p): T o jet o T^-1.
template <class Real>
FlowJet<Real> jet_in_discrete_variables(const FlowProblem<Real>& problem, const FlowJet<Real>& jet,
                                        const Real& c) {
  const auto start =
      without_constants(discrete_variables(starting_jet(problem), *problem.system, c));
  const auto back = inverse(start);
  const auto end = discrete_variables(jet, *problem.system, c);
  return compose(end, back);
}

template <class Real>
void expect_discrete_symplecticity(double duration, int order, double step, double tolerance) {
  auto flow = test::flow_of<Real>(test::paper_orbit(), order);
  flow.duration = Real(duration);
  const auto problem = test::problem_of(flow);
  IntegrationStatistics statistics;
  for (const double beta : {0.1, 0.25, 0.5}) {
    const auto jet = newmark(problem, beta, step, &statistics);
    const Real h = Real(duration) / Real(std::lround(duration / step));
    const auto discrete = jet_in_discrete_variables(problem, jet, Real(Real(beta) * h * h));
    EXPECT_LE(test::worst_symplecticity(discrete), tolerance) << beta;
    // In (q, M q') the defect is of the size of beta h^2 (data/paper/README.md).
    EXPECT_GE(test::worst_symplecticity(jet), 1e-3 * beta * step * step) << beta;
  }
  EXPECT_EQ(statistics.steps, std::lround(duration / step));
}

TEST(Newmark, PreservesTheTwoFormOfTheDiscreteVariablesOnly) {
  expect_discrete_symplecticity<double>(10, 4, 0.125, 1e-13);
  expect_discrete_symplecticity<double>(10, 4, 0.03125, 1e-13);
  expect_discrete_symplecticity<Extended>(4, 3, 0.125, 1e-30);
}

TEST(Newmark, OutAndBackIsTheIdentity) {
  for (const double beta : {0.1, 0.25, 0.5}) {
    const test::Flow<double> out{test::pendulum(), {0.4, 0.9}, 8, 4, {}};
    auto back = out;
    const auto there = newmark(test::problem_of(out), beta, 0.25);
    back.start = test::final_state(there);
    back.duration = -8;
    const auto returned = newmark(test::problem_of(back), beta, 0.25);
    const auto both = test::chained(returned, there);
    const auto identity = starting_jet(test::problem_of(out));
    const double size = test::largest_coefficient(there[0]) + test::largest_coefficient(there[1]);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(test::largest_coefficient(both[i] - identity[i]), 1e-14 * std::pow(size, 2));
    }
  }
}

// Expected: one step from rest at distance 1 from a centre, beta = 1/2, h = 1/2: the equation
// r + (1/8)/r^2 = 1 has the roots (1 + sqrt 5)/4 and 1/2; the first is connected to the start.
TEST(Newmark, TakesTheSolutionConnectedToTheStart) {
  const test::Flow<double> flow{kepler(), {1, 0, 0, 0, 0, 0}, 0.5, 2, {}};
  EXPECT_NEAR(newmark(test::problem_of(flow), 0.5, 0.5)[0][0], (1 + std::sqrt(5.0)) / 4, 1e-15);
}

TEST(Newmark, AStepWithoutConnectedSolutionIsANumericalError) {
  // r + c/r^2 >= (27 c/4)^(1/3) > 1 for c = h^2/2 and h = 0.6, so that there is no solution.
  const test::Flow<double> fall{kepler(), {1, 0, 0, 0, 0, 0}, 0.6, 2, {}};
  test::expect_error(ErrorKind::numerical, "Newmark: the implicit equation has no solution",
                     [&] { newmark(test::problem_of(fall), 0.5, 0.6); });
  // q + (9/4) sin q = x, x = 5.42: beyond the fold at 2.03, where x = 4.05, only the solution near
  // 6 is left, which is not the one that small steps lead to.
  const test::Flow<double> swing{test::pendulum(), {0.5, 2}, 6, 2, {}};
  test::expect_error(ErrorKind::numerical, "in step 1 of 2, of size 3 from t = 0",
                     [&] { newmark(test::problem_of(swing), 0.25, 3); });
  const test::Flow<double> collided{kepler(), {0, 0, 0, 0, 1, 0}, 1, 2, {}};
  test::expect_error(ErrorKind::numerical, "Newmark: the force is not finite",
                     [&] { newmark(test::problem_of(collided), 0.25, 0.5); });
}

// Expected: the root of q + (9/4) sin q = 1/2 + (9/4) sin 1/2 + 3 (1 - (3/2) sin 1/2) below the
// fold at 2.03, by bisection.
TEST(Newmark, CoarseStepsFollowTheSolution) {
  const test::Flow<double> flow{test::pendulum(), {0.5, 1}, 3, 2, {}};
  const double x = 0.5 + 2.25 * std::sin(0.5) + 3 * (1 - 1.5 * std::sin(0.5));
  double low = 0;
  double high = 2;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (middle + 2.25 * std::sin(middle) < x ? low : high) = middle;
  }
  EXPECT_NEAR(newmark(test::problem_of(flow), 0.25, 3)[0][0], low, 1e-14);
}

TEST(Newmark, TakesOneEvaluationAStep) {
  const auto flow = test::flow_of(test::paper_orbit(), 1);
  const auto problem = test::problem_of(flow);
  IntegrationStatistics statistics;
  newmark(problem, 0.25, 0.01, &statistics);
  EXPECT_EQ(statistics.steps, 3142);
  EXPECT_EQ(statistics.vector_field_evaluations, 3143);
  EXPECT_GT(statistics.wall_seconds, 0);
}

TEST(Newmark, ZeroDurationIsTheIdentityExactly) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  flow.duration = 0;
  const auto problem = test::problem_of(flow);
  test::expect_identity(newmark(problem, 0.25, 0.1), flow.start);
}

TEST(Newmark, BadSettingsAndSystemsAreUsageErrors) {
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, 1, 1, {}};
  const auto problem = test::problem_of(flow);
  for (const double beta : {-0.01, 0.51, std::nan("")}) {
    test::expect_error(ErrorKind::usage, "beta must be between 0 and 1/2",
                       [&] { newmark(problem, beta, 0.1); });
  }
  for (const double beta : {0.0, 0.25}) {
    test::expect_error(ErrorKind::usage, "Newmark: the step must be positive",
                       [&] { newmark(problem, beta, 0); });
    auto general = flow;
    general.system.second_order.reset();
    test::expect_error(ErrorKind::usage, "no second-order form",
                       [&] { newmark(test::problem_of(general), beta, 0.1); });
  }
}

}  // namespace
}  // namespace hamjet
