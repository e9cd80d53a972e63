#include "hamjet/integrators/stormer_verlet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "integrator_checks.hpp"
#include "integrators/small_systems.hpp"
#include "support/convergence.hpp"
#include "support/errors.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

template <class Real>
FlowJet<Real> stormer(const FlowProblem<Real>& problem, double step) {
  IntegrationStatistics statistics;
  return integrate_stormer(problem, {.step = step}, statistics);
}
template <class Real>
FlowJet<Real> verlet(const FlowProblem<Real>& problem, double step) {
  IntegrationStatistics statistics;
  return integrate_velocity_verlet(problem, {.step = step}, statistics);
}

template <class Real>
std::vector<Series<Real>> force_of(const DynamicalSystem& system,
                                   const std::vector<Series<Real>>& q) {
  return evaluate_on_series<Real>(system.second_order->force, q);
}

// Expected: the n-th power of the matrix of one step, from the recurrence of the method by hand, in
// extended precision; mass 2.5, stiffness 0.7.
template <class Real, class Run>
void expect_oscillator(const Run& run, bool is_verlet, double tolerance) {
  const Extended m = 2.5;
  const Extended k = 0.7;
  const DynamicalSystem system = harmonic_oscillator(2.5, 0.7);
  for (const int direction : {1, -1}) {
    const int n = 64;
    test::Flow<Real> flow{system, {Real(0.3), Real(-0.8)}, Real(direction * n) / 8, 3, {}};
    const auto jet = run(test::problem_of(flow), 0.125);
    const Extended h = Extended(direction) / 8;
    Extended q[3] = {0.3, 1, 0};
    Extended p[3] = {-0.8, 0, 1};
    for (int step = 0; step < n; ++step) {
      for (int c = 0; c < 3; ++c) {
        const Extended kick = -h * k * q[c];
        if (is_verlet) {
          const Extended before = q[c];
          q[c] += h * p[c] / m + h * kick / (2 * m);
          p[c] -= h * k * (before + q[c]) / 2;
        } else {
          p[c] += kick;
          q[c] += h * p[c] / m;
        }
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LE(std::abs(static_cast<double>(Extended(Extended(jet[0][c]) - q[c]))), tolerance);
      EXPECT_LE(std::abs(static_cast<double>(Extended(Extended(jet[1][c]) - p[c]))), tolerance);
    }
    for (std::size_t c = 3; c < jet[0].size(); ++c) {
      EXPECT_EQ(jet[0][c], 0);
      EXPECT_EQ(jet[1][c], 0);
    }
  }
}

TEST(Stormer, IsTheDiscreteOscillatorWithItsMass) {
  const bool is_verlet = false;
  expect_oscillator<double>([](const auto& p, double h) { return stormer(p, h); }, is_verlet,
                            1e-14);
  expect_oscillator<Extended>([](const auto& p, double h) { return stormer(p, h); }, is_verlet,
                              1e-32);
}

TEST(VelocityVerlet, IsTheDiscreteOscillatorWithItsMass) {
  const bool is_verlet = true;
  expect_oscillator<double>([](const auto& p, double h) { return verlet(p, h); }, is_verlet, 1e-14);
  expect_oscillator<Extended>([](const auto& p, double h) { return verlet(p, h); }, is_verlet,
                              1e-32);
}

/// H = p^T W p / 2 + V(q) with a full matrix W = [[2, 1/2], [1/2, 4]].

// Expected: the formulas of the methods written out with whole series.
TEST(VelocityVerlet, StepsAreThePrintedFormulasOnSeries) {
  const test::Flow<double> flow{test::coupled_masses(), {0.3, -0.2, 0.5, 0.1}, 0.5, 4, {}};
  const double h = 0.125;
  const double w[2][2] = {{2, 0.5}, {0.5, 4}};
  const auto problem = test::problem_of(flow);
  const auto velocity = [&](const std::vector<Series<double>>& p, std::size_t i) {
    return w[i][0] * p[0] + w[i][1] * p[1];
  };
  for (const bool is_verlet : {false, true}) {
    auto z = starting_jet(problem);
    std::vector<Series<double>> q{z[0], z[1]};
    std::vector<Series<double>> p{z[2], z[3]};
    for (int step = 0; step < 4; ++step) {
      const auto force = force_of(flow.system, q);
      if (is_verlet) {
        for (std::size_t i = 0; i < 2; ++i) {
          q[i] += h * velocity(p, i) + h * h / 2 * velocity(force, i);
        }
        const auto end = force_of(flow.system, q);
        for (std::size_t i = 0; i < 2; ++i) p[i] += h / 2 * (force[i] + end[i]);
      } else {
        for (std::size_t i = 0; i < 2; ++i) p[i] += h * force[i];
        for (std::size_t i = 0; i < 2; ++i) q[i] += h * velocity(p, i);
      }
    }
    const auto jet = is_verlet ? verlet(problem, h) : stormer(problem, h);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(test::largest_coefficient(jet[i] - q[i]), 1e-14 * test::largest_coefficient(q[i]));
      EXPECT_LE(test::largest_coefficient(jet[2 + i] - p[i]),
                1e-14 * test::largest_coefficient(p[i]));
    }
  }
}

// Expected: the orders 1 and 2 of the methods, for the nominal and for the coefficients of degree
// 2: a one-step method commutes with differentiation by the initial state.
TEST(VelocityVerlet, OrdersOfConvergenceAreOneAndTwo) {
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.duration = 2;
  const auto expected = test::run_gauss(flow, test::adaptive(8, 1e-18));
  for (const bool is_verlet : {false, true}) {
    const auto [steps, errors] = test::convergence(
        flow, expected, {200, 400, 800, 1600}, [&](const auto& problem, double step) {
          return is_verlet ? verlet(problem, step) : stormer(problem, step);
        });
    for (const auto& error : errors) {
      EXPECT_NEAR(test::fitted_order(steps, error), is_verlet ? 2 : 1, 0.03);
      EXPECT_GT(error.back(), 1e-9);  // above the rounding floor
      EXPECT_LT(error.back(), is_verlet ? 1e-4 : 2e-2);
    }
  }
}

TEST(VelocityVerlet, IsReversibleAndStormersRuleIsNot) {
  EXPECT_LE(test::return_error([](const auto& p, double h) { return verlet(p, h); }, 6, 0.2),
            1e-14);
  EXPECT_GE(test::return_error([](const auto& p, double h) { return stormer(p, h); }, 6, 0.2),
            1e-4);
}

// Expected: a symplectic map at every degree, however coarse the step.
TEST(VelocityVerlet, JetsAreSymplecticOnThePapersOrbit) {
  const auto nominal = test::flow_of(test::paper_orbit(), 4);
  const auto problem = test::problem_of(nominal);
  for (const double step : {0.5, 0.2, 0.05}) {
    EXPECT_LE(test::worst_symplecticity(stormer(problem, step)), 1e-13) << step;
    EXPECT_LE(test::worst_symplecticity(verlet(problem, step)), 1e-13) << step;
  }
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 3);
  flow.duration = 10;
  const auto extended = test::problem_of(flow);
  EXPECT_LE(test::worst_symplecticity(stormer(extended, 0.25)), 1e-30);
  EXPECT_LE(test::worst_symplecticity(verlet(extended, 0.25)), 1e-30);
}

TEST(VelocityVerlet, ZeroDurationIsTheIdentityExactly) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  flow.duration = 0;
  const auto problem = test::problem_of(flow);
  for (const auto& jet : {stormer(problem, 0.1), verlet(problem, 0.1)}) {
    test::expect_identity(jet, flow.start);
  }
}

TEST(VelocityVerlet, TakesOneEvaluationAStep) {
  auto flow = test::flow_of(test::paper_orbit(), 1);
  const auto problem = test::problem_of(flow);
  IntegrationStatistics one;
  integrate_velocity_verlet(problem, {.step = 0.01}, one);
  EXPECT_EQ(one.steps, 3142);  // 10 pi is no multiple of 0.01
  EXPECT_EQ(one.vector_field_evaluations, 3143);
  EXPECT_GT(one.wall_seconds, 0);
  IntegrationStatistics other;
  integrate_stormer(problem, {.step = 0.01}, other);
  EXPECT_EQ(other.steps, 3142);
  EXPECT_EQ(other.vector_field_evaluations, 3142);
}

// Expected: the jet that is seen after k steps is that of a run of k steps, bit for bit, and being
// observed changes nothing.
TEST(VelocityVerlet, ObserverSeesTheJetOfEveryStep) {
  for (const bool is_verlet : {false, true}) {
    auto flow = test::flow_of(test::paper_orbit(), 2);
    flow.duration = -1;
    const auto problem = test::problem_of(flow);
    std::vector<double> times;
    std::vector<FlowJet<double>> seen;
    const auto observer = [&](const double& t, const FlowJet<double>& jet) {
      times.push_back(t);
      seen.push_back(jet);
    };
    IntegrationStatistics statistics;
    if (is_verlet) {
      integrate_velocity_verlet<double>(problem, {.step = 0.25}, statistics, observer);
    } else {
      integrate_stormer<double>(problem, {.step = 0.25}, statistics, observer);
    }
    EXPECT_EQ(times, (std::vector<double>{-0.25, -0.5, -0.75, -1}));
    for (std::size_t k = 0; k < seen.size(); ++k) {
      flow.duration = times[k];
      const auto part = test::problem_of(flow);
      const auto jet = is_verlet ? verlet(part, 0.25) : stormer(part, 0.25);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t c = 0; c < jet[i].size(); ++c) EXPECT_EQ(seen[k][i][c], jet[i][c]);
      }
    }
  }
}

// Expected: q = q0 + p0 t - 3 t^2/2 and p = p0 - 3 t, which Verlet gives exactly in steps of 1/4;
// and for F = q one step of the matrix [[1 + h^2/2, h], [h + h^3/4, 1 + h^2/2]].
TEST(VelocityVerlet, TakesForcesThatAreConstantOrTheCoordinateItself) {
  const auto fall =
      make_system("fall", 1, [](auto q, auto p) { return p[0] * p[0] / 2 + 3 * q[0]; });
  const test::Flow<double> falling{fall, {1, 0.5}, 2, 2, {}};
  const auto end = verlet(test::problem_of(falling), 0.25);
  EXPECT_EQ(std::vector<double>(end[0].coefficients().begin(), end[0].coefficients().end()),
            (std::vector<double>{-4, 1, 2, 0, 0, 0}));
  EXPECT_EQ(std::vector<double>(end[1].coefficients().begin(), end[1].coefficients().end()),
            (std::vector<double>{-5.5, 0, 1, 0, 0, 0}));
  const auto repulsion =
      make_system("repulsion", 1, [](auto q, auto p) { return p[0] * p[0] / 2 - q[0] * q[0] / 2; });
  const test::Flow<double> repelled{repulsion, {1, 0}, 0.5, 1, {}};
  const auto one = verlet(test::problem_of(repelled), 0.5);
  EXPECT_EQ(std::vector<double>(one[0].coefficients().begin(), one[0].coefficients().end()),
            (std::vector<double>{1.125, 1.125, 0.5}));
  EXPECT_EQ(std::vector<double>(one[1].coefficients().begin(), one[1].coefficients().end()),
            (std::vector<double>{0.53125, 0.53125, 1.125}));
}

TEST(VelocityVerlet, CompensatedSummationKeepsRoundOffDown) {
  // 2e5 steps of the oscillator; expected: the closed form of the discrete rotation, q = cos(n a),
  // p = -sin(n a) sqrt(1 - h^2/4), cos a = 1 - h^2/2. Without compensation the errors add up to
  // some 1e-14 or more.
  const int n = 200000;
  const Extended h = Extended(1) / 1024;
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, n / 1024.0, 1, {}};
  const auto jet = verlet(test::problem_of(flow), 1.0 / 1024);
  const Extended angle = n * acos(Extended(1 - h * h / 2));
  EXPECT_LE(std::abs(jet[0][0] - static_cast<double>(Extended(cos(angle)))), 1e-15);
  const Extended p = -sin(angle) * sqrt(Extended(1 - h * h / 4));
  EXPECT_LE(std::abs(jet[1][0] - static_cast<double>(p)), 1e-15);
}

TEST(VelocityVerlet, BadSettingsAndSystemsAreUsageErrors) {
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, 1, 1, {}};
  const auto problem = test::problem_of(flow);
  for (const double step : {0.0, -0.1, std::nan("")}) {
    test::expect_error(ErrorKind::usage, "velocity Verlet: the step must be positive",
                       [&] { verlet(problem, step); });
    test::expect_error(ErrorKind::usage, "Störmer's rule: the step must be positive",
                       [&] { stormer(problem, step); });
  }
  const auto product =
      make_system("product", 1, [](auto q, auto p) { return q[0] * q[0] * p[0] * p[0]; });
  const test::Flow<double> other{product, {1, 1}, 1, 1, {}};
  test::expect_error(ErrorKind::usage, "the system product has no second-order form",
                     [&] { verlet(test::problem_of(other), 0.1); });
  test::expect_error(ErrorKind::usage, "q' = M^-1 p",
                     [&] { stormer(test::problem_of(other), 0.1); });
  test::expect_error(ErrorKind::too_large, "steps would be needed",
                     [&] { verlet(problem, 1e-12); });
}

TEST(VelocityVerlet, CollisionIsANumericalErrorThatNamesTimeAndStep) {
  // The orbit starts in the centre.
  const test::Flow<double> flow{kepler(), {0, 0, 0, 0, 1, 0}, 1, 2, {}};
  test::expect_error(ErrorKind::numerical, "velocity Verlet: the force is not finite",
                     [&] { verlet(test::problem_of(flow), 0.5); });
  test::expect_error(ErrorKind::numerical, "in step 1 of 2, of size 0.5 from t = 0",
                     [&] { stormer(test::problem_of(flow), 0.5); });
  // x = 1, p = 1: Störmer's first step with h = 1 gives p = 0 and x = 1, then p = -1 and x = 0.
  const test::Flow<double> late{kepler(), {1, 0, 0, 1, 0, 0}, 4, 2, {}};
  test::expect_error(ErrorKind::numerical, "in step 2 of 4, of size 1 from t = 1",
                     [&] { stormer(test::problem_of(late), 1); });
}

}  // namespace
}  // namespace hamjet
