#include "hamjet/integrators/cvode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "../../src/integrators/cvode/cvode_block_solver.hpp"
#include "../../src/integrators/series_vector_field.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "integrator_checks.hpp"
#include "support/magnitude.hpp"

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
  const FlowProblem<double> problem{system, SeriesSpace::create(2, 1), {0, 1},
                                    {1, 0}, ClockTime::epoch(),        1};
  const std::string text = error_text(problem, CvodeMethod::bdf, 1e-6, ErrorKind::usage);
  EXPECT_NE(text.find("-DHAMJET_CVODE=ON"), std::string::npos) << text;
}

TEST_F(Cvode, IntegratesTheOscillatorForwardsAndBackwards) {
  const DynamicalSystem system = harmonic_oscillator(2, 0.5);
  for (const CvodeMethod method : both_methods) {
    for (const double duration : {7.3, -7.3}) {
      const auto problem = test::oscillator_problem(system, duration);
      test::expect_rotation(run(problem, method, 1e-10), duration, 2e-8);
    }
  }
}

// Expected: state and first column of the matrix of case SEED-10PI in reference_cases.json.
// Multistep errors add up over the steps: two or three digits above the tolerance.
TEST_F(Cvode, ErrorFallsWithTheToleranceOnThePapersOrbit) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  const auto problem = test::orbit_problem(system, 2, test::paper_orbit().duration);
  for (const CvodeMethod method : both_methods) {
    double previous = 1;
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const double error = test::paper_orbit_error(run(problem, method, tolerance));
      EXPECT_LE(error, 1e3 * tolerance);
      EXPECT_LE(error, previous / 10) << tolerance;
      previous = error;
    }
  }
}

// Expected: the flow back over the same time undoes the flow.
TEST_F(Cvode, ForwardThenBackwardReturns) {
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  for (const CvodeMethod method : both_methods) {
    const FlowJet<double> out = run(test::orbit_problem(system, 1, 5), method, 1e-11);
    FlowProblem<double> back = test::orbit_problem(system, 1, -5);
    for (std::size_t c = 0; c < 6; ++c) back.initial_state[c] = out[c][0];
    const FlowJet<double> home = run(back, method, 1e-11);
    test::expect_return(out, home, test::orbit_problem(system, 1, 5).initial_state, 1e-7, 1e-6);
  }
}

// Expected: by definition of the flow at time zero (CVODE itself would refuse: CV_TOO_CLOSE).
TEST_F(Cvode, ZeroDurationIsTheIdentityExactly) {
  const DynamicalSystem system = kepler();
  const auto problem = test::orbit_problem(system, 2, 0);
  for (const CvodeMethod method : both_methods) {
    test::expect_identity(run(problem, method, 1e-6), problem.initial_state);
  }
}

// Expected: components out of the plane are exactly zero on a planar orbit; an absolute tolerance
// of zero would be refused there (CV_ILL_INPUT).
TEST_F(Cvode, TheObserverSeesEveryStepAndZerosStayZero) {
  const DynamicalSystem system = kepler();
  FlowProblem<double> problem = test::orbit_problem(system, 2, 3);
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
  EXPECT_THROW(integrate_cvode(test::orbit_problem(system, 1, 3), {CvodeMethod::bdf, 1e-8},
                               statistics, [](double, const FlowJet<double>&) { throw 7; }),
               int);
}

// A fall from rest at distance 1 meets the centre at pi / (2 sqrt 2) = 1.1107 (case RECT-1.0 in
// reference_cases.json). CVODE itself reports success behind it.
TEST_F(Cvode, ACollisionIsAnError) {
  const DynamicalSystem system = kepler();
  for (const int order : {0, 2}) {
    FlowProblem<double> problem = test::orbit_problem(system, order, 2);
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
  const auto problem = test::orbit_problem(system, 1, 1);
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
  const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  IntegrationStatistics statistics;
  CvodeCounts counts;
  integrate_cvode(test::orbit_problem(system, 4, 10), {CvodeMethod::bdf, 1e-7, &counts},
                  statistics);
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
  const FlowProblem<double> problem{system,           SeriesSpace::create(4, 2), {0, 1, 2, 3},
                                    {1, 0, 0.1, 1.1}, ClockTime::epoch(),        2.5};
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
  ASSERT_TRUE(solver.evaluate(state.data(), 0));
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
      residual = test::larger(residual, std::abs(sum));
      change = std::max(change, std::abs(x[i] - b[i]));
      size = std::max(size, std::abs(x[i]));
    }
    EXPECT_LE(residual, 1e-7 * size) << gamma;
    EXPECT_GT(change, 1e-3) << "the test must not be empty";
  }
}

TEST(CoefficientBlockSolver, ReportsSingularAndNotFiniteMatrices) {
  const DynamicalSystem system = harmonic_oscillator();
  const FlowProblem<double> oscillator{system, SeriesSpace::create(2, 1), {0, 1},
                                       {1, 0}, ClockTime::epoch(),        1};
  CoefficientBlockSolver solver(oscillator);
  const std::vector<double> state(6, 1.0);
  ASSERT_TRUE(solver.evaluate(state.data(), 0));
  EXPECT_TRUE(solver.factorise(1));
  EXPECT_FALSE(solver.factorise(std::numeric_limits<double>::infinity()));

  const DynamicalSystem gravity = kepler();
  CoefficientBlockSolver at_centre(test::orbit_problem(gravity, 1, 1));
  EXPECT_FALSE(at_centre.evaluate(std::vector<double>(42, 0.0).data(), 0));
}

}  // namespace
}  // namespace hamjet
