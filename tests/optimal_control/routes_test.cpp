#include <gtest/gtest.h>

#include "control_problems.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "optimal_control/hamiltonian_discretization.hpp"
#include "optimal_control/karush_kuhn_tucker.hpp"

// The paper's diagram commutes: discretise then optimise, optimise then discretise and the discrete
// maximum principle are three sets of equations with one solution. And their maps are symplectic.

namespace hamjet::test {
namespace {

/// Scaled defect of the Poisson brackets of a step's linear map.
double defect(const Eigen::MatrixXd& jacobian) {
  const Eigen::Index n = jacobian.rows() / 2;
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  j.topRightCorner(n, n).setIdentity();
  j.bottomLeftCorner(n, n) = -Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd size = jacobian.cwiseAbs() * j.cwiseAbs() * jacobian.cwiseAbs().transpose();
  return (jacobian * j * jacobian.transpose() - j).cwiseAbs().maxCoeff() / size.maxCoeff();
}

TEST(ControlRoutes, AdvanceMapsAreSymplecticAndEqual) {
  const auto heisenberg_problem = heisenberg({0, 0, 0}, {0, 0, 1});
  const auto pendulum_problem = pendulum({0, 0}, {1, 0});
  for (const OptimalControlProblem* problem : {&heisenberg_problem, &pendulum_problem}) {
    for (const Discretization form : both_forms) {
      DiscreteMaximumPrinciple principle(*problem, form, 0.1);
      HamiltonianDiscretization reduced(*problem, form, 0.1);
      const auto size = static_cast<Eigen::Index>(2 * problem->states);
      Eigen::VectorXd point = Eigen::VectorXd::LinSpaced(size, 0.4, -0.7);
      const Eigen::VectorXd guess = Eigen::VectorXd::Zero(Eigen::Index(problem->controls));
      for (int k = 0; k < 5; ++k) {
        const AdvancedPoint a = principle.advance(point, guess);
        const AdvancedPoint b = reduced.advance(point, guess);
        EXPECT_LT(defect(a.jacobian), 1e-15);
        EXPECT_LT(defect(b.jacobian), 1e-15);
        EXPECT_LT((a.point - b.point).norm(), 1e-14);
        EXPECT_LT((a.control - b.control).norm(), 1e-14);
        EXPECT_LT((a.jacobian - b.jacobian).norm(), 1e-14);
        // The Jacobian is not the identity, which is symplectic too.
        EXPECT_GT((a.jacobian - Eigen::MatrixXd::Identity(size, size)).norm(), 0.05);
        // The Jacobian is compared with central differences of the map, whose error is about 1e-10.
        for (Eigen::Index j = 0; j < size; ++j) {
          const Eigen::VectorXd shift = 1e-5 * Eigen::VectorXd::Unit(size, j);
          const Eigen::VectorXd slope = (principle.advance(point + shift, guess).point -
                                         principle.advance(point - shift, guess).point) /
                                        2e-5;
          EXPECT_LT((slope - a.jacobian.col(j)).norm(), 1e-8);
        }
        point = a.point;
      }
    }
  }
}

/// The three solutions of a problem, all from a costate that is wrong by 1 %.
void expect_equal_routes(const OptimalControlProblem& problem, Discretization form, double duration,
                         ShootingSettings settings) {
  const Solved principle = solve(problem, form, duration, settings);
  const double step = duration / static_cast<double>(settings.steps);
  const Eigen::VectorXd p = principle.solution.trajectory.costates.front();
  const Eigen::MatrixXd& family = principle.solution.family;
  settings.costate_guess = 1.01 * p;
  if (family.cols() > 0) settings.conditions = CostateConditions{family, family.transpose() * p};
  HamiltonianDiscretization reduced(problem, form, step);
  const ShootingSolution b = solve_by_shooting(reduced, problem, settings);
  DiscreteMaximumPrinciple map(problem, form, step);
  Eigen::VectorXd point(2 * p.size());
  point << settings.state_guess, settings.costate_guess;
  const auto guess =
      trajectory_of(propagate_arc(map, point, settings.control_guess, settings.steps));
  const KarushKuhnTuckerSolution a =
      solve_karush_kuhn_tucker(problem, form, step, guess, {}, settings.conditions);
  EXPECT_GT(difference(guess, b.trajectory).largest(),
            1e-3);  // shows that the solver had something to do
  EXPECT_LT(difference(a.trajectory, b.trajectory).largest(), 5e-14);
  EXPECT_LT(difference(principle.solution.trajectory, b.trajectory).largest(), 5e-14);
  EXPECT_NEAR(discrete_cost(problem, form, step, a.trajectory) /
                  discrete_cost(problem, form, step, b.trajectory),
              1, 1e-14);
  EXPECT_LT((a.trajectory.initial_multipliers - b.trajectory.initial_multipliers).norm(), 1e-12);
  EXPECT_LT((a.trajectory.final_multipliers - b.trajectory.final_multipliers).norm(), 1e-12);
}

TEST(ControlRoutes, DiscretiseThenOptimiseIsOptimiseThenDiscretise) {
  const auto loop = heisenberg({0, 0, 0}, {0, 0, 1});
  const auto line = heisenberg({0, 0, 0}, {1, 0, 0});
  const auto swing = pendulum({0, 0}, {1, 0.5});
  for (const Discretization form : both_forms) {
    expect_equal_routes(loop, form, 1, shooting(loop, 50, 4, {0, 0, 0}, {-1, 0, -2}));
    expect_equal_routes(line, form, 1, shooting(line, 20, 2, {0, 0, 0}, {-1, .2, .3}));
    expect_equal_routes(swing, form, 1.5, shooting(swing, 30, 3, {0, 0}, {-1, -1}));
  }
}

/// The gradient of the augmented cost by the inner states, controls and multipliers at a solution,
/// the term <p, x' - f> with the given sign.
double augmented_cost_slope(double sign, Discretization form) {
  const Solved loop = solve_loop(form, 1, 1, 12);
  const DiscreteTrajectory& t = loop.solution.trajectory;
  const double tau = 1.0 / 12;
  constexpr std::size_t n = 3;
  const HeisenbergFunctions functions;
  // Two steps (k, k + 1) that share x_(k+1): all terms in which that and u_k, p^d_k occur.
  const auto cost = record(n + 2 + n, [&](std::span<const Expression> w) {
    Expression sum(0);
    for (std::size_t k = 4; k < 6; ++k) {
      std::vector<Expression> before, after, p, u;
      for (std::size_t i = 0; i < n; ++i) {
        const auto c = static_cast<Eigen::Index>(i);
        before.push_back(k == 5 ? w[i] : Expression(t.states[k](c)));
        after.push_back(k == 4 ? w[i] : Expression(t.states[k + 1](c)));
        const double weight = costate_weight(form);
        const double own = t.costates[k](c) + weight * (t.costates[k + 1](c) - t.costates[k](c));
        p.push_back(k == 4 ? w[n + 2 + i] : Expression(own));
      }
      for (std::size_t i = 0; i < 2; ++i) {
        u.push_back(k == 4 ? w[n + i] : Expression(t.controls[k](static_cast<Eigen::Index>(i))));
      }
      std::vector<Expression> x;
      for (std::size_t i = 0; i < n; ++i) {
        x.push_back(before[i] + state_weight(form) * (after[i] - before[i]));
      }
      const std::span<const Expression> xs(x), us(u);
      const std::vector<Expression> f = functions.dynamics(xs, us);
      sum += tau * functions.running_cost(xs, us);
      for (std::size_t i = 0; i < n; ++i) sum += sign * p[i] * (after[i] - before[i] - tau * f[i]);
    }
    return std::vector<Expression>{sum};
  });
  DifferentiableFunction<double> slope(gradient(cost));
  std::vector<double> at(t.states[5].begin(), t.states[5].end());
  at.insert(at.end(), t.controls[4].begin(), t.controls[4].end());
  const Eigen::VectorXd p = t.costates[4] + costate_weight(form) * (t.costates[5] - t.costates[4]);
  at.insert(at.end(), p.begin(), p.end());
  slope.evaluate(at);
  return slope.values().lpNorm<Eigen::Infinity>();
}

// J_a = sum tau (g - <p, x' - f>): stationary at the solution. The printed sign, +, is not.
TEST(ControlRoutes, AugmentedCostHasMinusBeforeTheConstraint) {
  for (const Discretization form : both_forms) {
    EXPECT_LT(augmented_cost_slope(-1, form), 1e-14);
    EXPECT_GT(augmented_cost_slope(+1, form), 0.1);
  }
}

}  // namespace
}  // namespace hamjet::test
