#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <hamjet/dynamics/harmonic_oscillator.hpp>
#include <hamjet/dynamics/zonal_gravity.hpp>
#include <hamjet/error.hpp>
#include <hamjet/integrators/cvode.hpp>
#include <hamjet/integrators/explicit_runge_kutta.hpp>
#include <limits>
#include <string>
#include <vector>

#include "../../src/integrators/cvode_block_solver.hpp"
#include "../../src/integrators/series_vector_field.hpp"

namespace hamjet {
namespace {

constexpr CvodeMethod both_methods[] = {CvodeMethod::adams, CvodeMethod::bdf};

/// Tests of the integration itself; a build without CVODE has only the refusal to show.
class Cvode : public testing::Test {
 protected:
  void SetUp() override {
    if (!cvode_available()) GTEST_SKIP() << "this build has no CVODE";
  }
};

/// The paper's orbit; inputs from reference_cases.json, case SEED-10PI.
DynamicalSystem paper_field() {
  return zonal_gravity(
      {1.0, 0x1.d283e1c01dcf3p-1, {{2, 0x1.1bcdd8a6cfd70p-10}, {3, 0x1.53e5d6a0f845cp-19}}});
}

FlowProblem<double> orbit(const DynamicalSystem& system, int order, double duration) {
  return {&system,
          SeriesSpace::create(6, order),
          {0, 1, 2, 3, 4, 5},
          {1, 0, 0, 0, 0x1.23e2896280f23p-1, 0x1.f98f3adef13f2p-1},
          duration};
}

FlowJet<double> run(const FlowProblem<double>& problem, CvodeMethod method, double tolerance) {
  IntegrationStatistics statistics;
  return integrate_cvode(problem, {method, tolerance}, statistics);
}

std::string error_text(const FlowProblem<double>& problem, CvodeMethod method, double tolerance,
                       ErrorKind kind) {
  testing::internal::CaptureStderr();
  std::string text = "no error";
  try {
    run(problem, method, tolerance);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    text = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "SUNDIALS wrote to standard error";
  return text;
}

TEST(CvodeAbsent, SaysHowToBuildIt) {
  if (cvode_available()) GTEST_SKIP() << "this build has CVODE";
  const DynamicalSystem system = harmonic_oscillator();
  const FlowProblem<double> problem{&system, SeriesSpace::create(2, 1), {0, 1}, {1, 0}, 1};
  const std::string text = error_text(problem, CvodeMethod::bdf, 1e-6, ErrorKind::usage);
  EXPECT_NE(text.find("-DHAMJET_CVODE=ON"), std::string::npos) << text;
}

// Expected: q = q0 cos wt + p0 sin wt, p = p0 cos wt - q0 sin wt for mass 2, stiffness 0.5 (w =
// 1/2, m w = 1), and the same rotation at degree 1; a linear flow has nothing above.
TEST_F(Cvode, IntegratesTheOscillatorForwardsAndBackwards) {
  const DynamicalSystem system = harmonic_oscillator(2, 0.5);
  for (const CvodeMethod method : both_methods) {
    for (const double duration : {7.3, -7.3}) {
      const FlowProblem<double> problem{
          &system, SeriesSpace::create(2, 3), {0, 1}, {0.3, -0.7}, duration};
      const FlowJet<double> jet = run(problem, method, 1e-10);
      const double c = std::cos(duration / 2);
      const double s = std::sin(duration / 2);
      const double expected_q[] = {0.3 * c - 0.7 * s, c, s};
      const double expected_p[] = {-0.7 * c - 0.3 * s, -s, c};
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(jet[0][k], expected_q[k], 2e-8);
        EXPECT_NEAR(jet[1][k], expected_p[k], 2e-8);
      }
      for (std::size_t k = 3; k < jet[0].size(); ++k) {
        EXPECT_EQ(jet[0][k], 0);
        EXPECT_EQ(jet[1][k], 0);
      }
    }
  }
}

// Expected: state and first column of the matrix of case SEED-10PI in reference_cases.json.
// Multistep errors add up over the steps: two or three digits above the tolerance.
TEST_F(Cvode, ErrorFallsWithTheToleranceOnThePapersOrbit) {
  const double state[] = {0.766193477722799312, -0.377383325619903653, -0.643494936008871042,
                          0.612704207756633850, 0.442268657796718223,  0.773489074513720723};
  const double column[] = {-82.9039186170813560, -60.9735264196907293, -106.657871345703589,
                           85.0485072235083642,  -42.0503868872173724, -71.9061898804517261};
  const DynamicalSystem system = paper_field();
  const auto problem = orbit(system, 2, 0x1.f6a7a2955385ep+4);
  for (const CvodeMethod method : both_methods) {
    double previous = 1;
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const FlowJet<double> jet = run(problem, method, tolerance);
      double error = 0;
      for (std::size_t c = 0; c < 6; ++c) {
        error = std::max(error, std::abs(jet[c][0] - state[c]));
        error = std::max(error, std::abs(jet[c][1] - column[c]) / 106.7);
      }
      EXPECT_LE(error, 1e3 * tolerance);
      EXPECT_LE(error, previous / 10) << tolerance;
      previous = error;
    }
  }
}

// Expected: the flow back over the same time undoes the flow.
TEST_F(Cvode, ForwardThenBackwardReturns) {
  const DynamicalSystem system = paper_field();
  for (const CvodeMethod method : both_methods) {
    const FlowJet<double> out = run(orbit(system, 1, 5), method, 1e-11);
    FlowProblem<double> back = orbit(system, 1, -5);
    for (std::size_t c = 0; c < 6; ++c) back.initial_state[c] = out[c][0];
    const FlowJet<double> home = run(back, method, 1e-11);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(home[i][0], orbit(system, 1, 5).initial_state[i], 1e-7);
      for (std::size_t j = 0; j < 6; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < 6; ++k) sum += home[i][1 + k] * out[k][1 + j];
        EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-6);
      }
    }
  }
}

// Expected: by definition of the flow at time zero (CVODE itself would refuse: CV_TOO_CLOSE).
TEST_F(Cvode, ZeroDurationIsTheIdentityExactly) {
  const DynamicalSystem system = kepler();
  const auto problem = orbit(system, 2, 0);
  for (const CvodeMethod method : both_methods) {
    const FlowJet<double> jet = run(problem, method, 1e-6);
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t k = 0; k < jet[c].size(); ++k) {
        EXPECT_EQ(jet[c][k], k == 0 ? problem.initial_state[c] : k == 1 + c ? 1 : 0);
      }
    }
  }
}

// Expected: components out of the plane are exactly zero on a planar orbit; an absolute tolerance
// of zero would be refused there (CV_ILL_INPUT).
TEST_F(Cvode, TheObserverSeesEveryStepAndZerosStayZero) {
  const DynamicalSystem system = kepler();
  FlowProblem<double> problem = orbit(system, 2, 3);
  problem.initial_state = {1, 0, 0, 0, 1.1, 0};
  for (const CvodeMethod method : both_methods) {
    IntegrationStatistics statistics;
    long calls = 0;
    double last_time = 0;
    const auto jet = integrate_cvode(problem, {method, 1e-8}, statistics,
                                     [&](double time, const FlowJet<double>& now) {
                                       EXPECT_GT(time, last_time);
                                       EXPECT_EQ(now[2][0], 0);
                                       last_time = time;
                                       ++calls;
                                     });
    EXPECT_EQ(calls, statistics.steps);
    EXPECT_EQ(last_time, 3);
    EXPECT_EQ(jet[2][0], 0);
    EXPECT_GT(statistics.vector_field_evaluations, statistics.steps);
  }
}

// Exceptions of the observer pass through.
TEST_F(Cvode, TheObserverMayStop) {
  const DynamicalSystem system = kepler();
  IntegrationStatistics statistics;
  EXPECT_THROW(integrate_cvode(orbit(system, 1, 3), {CvodeMethod::bdf, 1e-8}, statistics,
                               [](double, const FlowJet<double>&) { throw 7; }),
               int);
}

// A fall from rest at distance 1 meets the centre at pi / (2 sqrt 2) = 1.1107 (case RECT-1.0 in
// reference_cases.json). CVODE itself reports success behind it.
TEST_F(Cvode, ACollisionIsAnError) {
  const DynamicalSystem system = kepler();
  for (const int order : {0, 2}) {
    FlowProblem<double> problem = orbit(system, order, 2);
    problem.initial_state = {1, 0, 0, 0, 0, 0};
    for (const CvodeMethod method : both_methods) {
      for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-12}) {
        const std::string text = error_text(problem, method, tolerance, ErrorKind::numerical);
        EXPECT_NE(text.find(" t = 1.1"), std::string::npos) << text;
      }
    }
    problem.initial_state = {0, 0, 0, 0, 1, 0};
    for (const CvodeMethod method : both_methods) {
      EXPECT_NE(error_text(problem, method, 1e-6, ErrorKind::numerical), "no error");
    }
  }
}

TEST_F(Cvode, RefusesWrongInput) {
  const DynamicalSystem system = kepler();
  const auto problem = orbit(system, 1, 1);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double tolerance : {0.0, -1e-6, 1.0, nan, 1e-18}) {
    EXPECT_NE(error_text(problem, CvodeMethod::adams, tolerance, ErrorKind::usage), "no error");
  }
  for (const CvodeMethod method : both_methods) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
      FlowProblem<double> broken = problem;
      broken.initial_state[4] = bad;
      EXPECT_NE(error_text(broken, method, 1e-6, ErrorKind::numerical), "no error");
      broken = problem;
      broken.duration = bad;
      EXPECT_NE(error_text(broken, method, 1e-6, ErrorKind::numerical), "no error");
    }
  }
}

// Expected: with the exact linear solver Newton's iteration converges at once: hardly any failure,
// and about one iteration a step (measured: none, 1.3). J is then evaluated now and then only.
TEST_F(Cvode, NewtonConvergesWithTheBlockSolver) {
  const DynamicalSystem system = paper_field();
  IntegrationStatistics statistics;
  CvodeCounts counts;
  integrate_cvode(orbit(system, 4, 10), {CvodeMethod::bdf, 1e-7, &counts}, statistics);
  EXPECT_LE(counts.nonlinear_failures, statistics.steps / 100);
  EXPECT_LE(counts.nonlinear_iterations, 2 * statistics.steps);
  EXPECT_EQ(counts.linear_solves, counts.nonlinear_iterations);
  EXPECT_GT(counts.jacobian_evaluations, 0);
  EXPECT_LT(counts.jacobian_evaluations, statistics.steps / 10);
}

/// State in the layout of SeriesVectorField after a while on a planar orbit.
std::vector<double> planar_state(const FlowProblem<double>& problem) {
  IntegrationStatistics statistics;
  const FlowJet<double> jet = integrate_fehlberg78(problem, {.tolerance = 1e-12}, statistics);
  std::vector<double> state;
  for (const auto& series : jet) {
    state.insert(state.end(), series.coefficients().begin(), series.coefficients().end());
  }
  return state;
}

// Expected: x solves the dense system (I - gamma J) x = b, with all of J by central differences of
// the coefficient equations (which leave about 1e-9), order 2 in the plane: 4 components of 15
// coefficients.
TEST(CoefficientBlockSolver, SolvesTheDenseSystem) {
  const std::vector<std::size_t> plane{0, 1};
  const DynamicalSystem system = restrict_system(kepler(), plane);
  const FlowProblem<double> problem{
      &system, SeriesSpace::create(4, 2), {0, 1, 2, 3}, {1, 0, 0.1, 1.1}, 2.5};
  const std::vector<double> state = planar_state(problem);
  SeriesVectorField<double> field(problem, "test");
  const std::size_t n = field.size();
  ASSERT_EQ(n, 60U);

  std::vector<std::vector<double>> columns;
  for (std::size_t j = 0; j < n; ++j) {
    const double h = 1e-5;
    std::vector<double> moved = state;
    std::vector<double> forward(n);
    std::vector<double> backward(n);
    moved[j] = state[j] + h;
    field.evaluate(moved.data(), forward.data(), 0);
    moved[j] = state[j] - h;
    field.evaluate(moved.data(), backward.data(), 0);
    for (std::size_t i = 0; i < n; ++i) forward[i] = (forward[i] - backward[i]) / (2 * h);
    columns.push_back(forward);
  }
  std::vector<double> b(n);
  for (std::size_t i = 0; i < n; ++i) b[i] = std::sin(1.0 + static_cast<double>(3 * i));

  CoefficientBlockSolver solver(problem);
  ASSERT_TRUE(solver.evaluate(state.data()));
  for (const double gamma : {0.01, 0.3, -0.7}) {
    ASSERT_TRUE(solver.factorise(gamma));
    std::vector<double> x = b;
    solver.solve(x.data());
    double size = 0;
    double change = 0;
    double residual = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = x[i] - b[i];
      for (std::size_t j = 0; j < n; ++j) sum -= gamma * columns[j][i] * x[j];
      residual = std::max(residual, std::abs(sum));
      change = std::max(change, std::abs(x[i] - b[i]));
      size = std::max(size, std::abs(x[i]));
    }
    EXPECT_LE(residual, 1e-7 * size) << gamma;
    EXPECT_GT(change, 1e-3) << "the test must not be empty";
  }
}

TEST(CoefficientBlockSolver, ReportsSingularAndNotFiniteMatrices) {
  const DynamicalSystem system = harmonic_oscillator();
  const FlowProblem<double> oscillator{&system, SeriesSpace::create(2, 1), {0, 1}, {1, 0}, 1};
  CoefficientBlockSolver solver(oscillator);
  const std::vector<double> state(6, 1.0);
  ASSERT_TRUE(solver.evaluate(state.data()));
  EXPECT_TRUE(solver.factorise(1));
  EXPECT_FALSE(solver.factorise(std::numeric_limits<double>::infinity()));

  const DynamicalSystem gravity = kepler();
  CoefficientBlockSolver at_centre(orbit(gravity, 1, 1));
  EXPECT_FALSE(at_centre.evaluate(std::vector<double>(42, 0.0).data()));
}

}  // namespace
}  // namespace hamjet
