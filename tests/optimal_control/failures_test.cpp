#include <gtest/gtest.h>

#include "control_problems.hpp"
#include "optimal_control/karush_kuhn_tucker.hpp"
#include "optimal_control/lagrangian_plane.hpp"
#include "optimal_control/reduced_hamiltonian.hpp"
#include "support/errors.hpp"

// Mistakes are named, and what has no solution is an error, never a number.

namespace hamjet::test {
namespace {

TEST(ControlFailures, WrongSizesAreNamed) {
  expect_error(ErrorKind::usage, "wrong number of inputs of the final conditions, got 2, must be 3",
               [] {
                 heisenberg({0, 0, 0}, {1, 0});
               });
  expect_error(ErrorKind::usage,
               "wrong number of inputs of the initial conditions, got 4, must be 3", [] {
                 heisenberg({0, 0, 0, 0}, {1, 0, 0});
               });
  expect_error(ErrorKind::usage, "too many final conditions, got 3, must be at most 2", [] {
    double_integrator(fixed_state(std::vector<double>{0, 0}),
                      record(2, [](std::span<const Expression> x) {
                        return std::vector<Expression>{x[0], x[1], x[0] + x[1]};
                      }));
  });
  expect_error(ErrorKind::usage, "wrong number of values of the dynamics, got 3, must be 2", [] {
    make_optimal_control_problem("wrong", 2, 2, HeisenbergFunctions{},
                                 fixed_state(std::vector<double>{0, 0}),
                                 fixed_state(std::vector<double>{0, 0}));
  });
  const std::size_t one[] = {2};
  expect_error(ErrorKind::usage, "no component 2, must be below 2",
               [&] { fixed_components(2, one, std::vector<double>{0}); });
  const auto problem = heisenberg({0, 0, 0}, {0, 0, 1});
  expect_error(
      ErrorKind::usage, "wrong number of intervals, got 5, must be from 1 to the 4 steps", [&] {
        solve(problem, Discretization::stormer, 1, shooting(problem, 4, 5, {0, 0, 0}, {-1, 0, -2}));
      });
  expect_error(ErrorKind::usage, "wrong size of the first state or costate, must be 3", [&] {
    solve(problem, Discretization::stormer, 1, shooting(problem, 4, 1, {0, 0}, {-1, 0, -2}));
  });
}

// From rest, nothing moves to first order in z: no direction lowers z's residual.
TEST(ControlFailures, NoConvergenceNamesIterationResidualAndRank) {
  const auto problem = heisenberg({0, 0, 0}, {0, 0, 1});
  for (const Discretization form : both_forms) {
    expect_error(ErrorKind::numerical, "rank", [&] {
      solve(problem, form, 1, shooting(problem, 16, 1, {0, 0, 0}, {0, 0, 0}));
    });
  }
  ShootingSettings settings = shooting(problem, 16, 1, {0, 0, 0}, {-1, 0, -2});
  settings.newton.most_iterations = 2;
  expect_error(ErrorKind::numerical, "no convergence in 2 iterations, residual",
               [&] { solve(problem, Discretization::stormer, 1, settings); });
}

TEST(ControlFailures, NotANumberIsAnError) {
  const auto problem = heisenberg({0, 0, 0}, {0, 0, 1});
  const double nan = std::nan("");
  for (const Discretization form : both_forms) {
    expect_error(ErrorKind::numerical, "", [&] {
      solve(problem, form, 1, shooting(problem, 16, 2, {0, 0, 0}, {nan, 0, -2}));
    });
  }
  const auto unreachable = heisenberg({0, 0, 0}, {0, 0, nan});
  expect_error(ErrorKind::numerical, "not finite", [&] {
    solve(unreachable, Discretization::stormer, 1,
          shooting(unreachable, 16, 2, {0, 0, 0}, {-1, 0, -2}));
  });
}

/// A cost that does not bound the control.
struct WithoutCost {
  template <class T>
  T running_cost(std::span<const T> x, std::span<const T>) const {
    return x[0] * x[0];
  }
  template <class T>
  std::vector<T> dynamics(std::span<const T>, std::span<const T> u) const {
    return {u[0]};
  }
};

TEST(ControlFailures, StationarityThatDoesNotFixTheControlIsAnError) {
  const auto problem = make_optimal_control_problem(
      "unbounded", 1, 1, WithoutCost{}, fixed_state(std::vector{0.}), fixed_state(std::vector{1.}));
  ReducedHamiltonian reduced(problem);
  expect_error(ErrorKind::numerical, "stationarity in the controls",
               [&] { reduced.evaluate(Eigen::Vector2d(1, 1), Eigen::VectorXd::Zero(1)); });
  DiscreteMaximumPrinciple map(problem, Discretization::stormer, 0.1);
  expect_error(ErrorKind::numerical, "discrete maximum principle",
               [&] { map.advance(Eigen::Vector2d(1, 1), Eigen::VectorXd::Zero(1)); });
}

/// A state that does not move and a control without cost.
struct Idle {
  template <class T>
  T running_cost(std::span<const T> x, std::span<const T> u) const {
    return x[0] * x[0] + u[0] * T(0);
  }
  template <class T>
  std::vector<T> dynamics(std::span<const T> x, std::span<const T> u) const {
    return {x[0] * T(0) + u[0] * T(0)};
  }
};

// No equation determines the controls, so that their columns are zero.
TEST(ControlFailures, SparseEquationsWithoutTheControlAreSingular) {
  const auto problem = make_optimal_control_problem(
      "idle", 1, 1, Idle{}, fixed_state(std::vector{0.}), fixed_state(std::vector{1.}));
  DiscreteTrajectory guess;
  const Eigen::VectorXd half = Eigen::VectorXd::Constant(1, 0.5);
  guess.states.assign(5, half);
  guess.costates.assign(5, half);
  guess.controls.assign(4, half);
  expect_error(ErrorKind::numerical, "equations are singular",
               [&] { solve_karush_kuhn_tucker(problem, Discretization::stormer, 0.25, guess); });
}

// The problems have one and two degrees of freedom; for a matrix of one number Eigen reports
// success in any case.
TEST(ControlFailures, PhasesOfNoNumbersAreAnError) {
  for (const Eigen::Index n : {1, 2}) {
    LagrangianPlane plane(n);
    plane.advance(Eigen::MatrixXd::Constant(2 * n, 2 * n, std::nan("")));
    expect_error(ErrorKind::numerical, "second variation", [&] { plane.phases(); });
  }
}

// Without conditions the loop's solutions form a family, and the finite-dimensional equations are
// singular there; plain LU cannot go on, and must not return as if it had.
TEST(ControlFailures, FamilyWithoutConditionsIsNoSolutionOrAnHonestOne) {
  const auto problem = heisenberg({0, 0, 0}, {0, 0, 1});
  DiscreteTrajectory empty;
  expect_error(ErrorKind::usage, "N + 1 states",
               [&] { solve_karush_kuhn_tucker(problem, Discretization::stormer, 0.1, empty); });
  const Solved loop = solve_loop(Discretization::stormer, 1, 1, 10);
  try {
    const auto found =
        solve_karush_kuhn_tucker(problem, Discretization::stormer, 0.1, loop.solution.trajectory);
    EXPECT_LT(found.residual, 1e-10);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
  }
}

}  // namespace
}  // namespace hamjet::test
