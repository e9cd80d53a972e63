#include <gtest/gtest.h>

#include <Eigen/LU>

#include "control_problems.hpp"

// Free end points, on the double integrator: its least cost is delta^2 / (2 c^T W c) for the end
// condition <c, x(T)> = d, W being the Gramian and delta what the end lacks without control. Here W
// is summed step by step; the library has its closed form.

namespace hamjet::test {
namespace {

/// The Gramian by its definition: velocity tau u_j gained in step j moves the position by it times
/// the time left, which counts from the end of the step (Stormer) or its middle (midpoint).
Eigen::Matrix2d gramian(Discretization form, double duration, int steps) {
  const double tau = duration / steps;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int j = 0; j < steps; ++j) {
    const double left = steps - 1 - j + (form == Discretization::midpoint ? 0.5 : 0);
    const Eigen::Vector2d b(tau * left, 1);
    sum += tau * b * b.transpose();
  }
  return sum;
}

OperationList on_line(double a, double b, double c) {
  return record(2, [&](std::span<const Expression> x) {
    return std::vector<Expression>{a * x[0] + b * x[1] - c};
  });
}

TEST(Transversality, GramianInClosedFormIsItsSum) {
  for (const Discretization form : both_forms) {
    for (const int steps : {1, 2, 5, 40}) {
      const auto closed = double_integrator_gramian(form, 3, std::size_t(steps));
      const Eigen::Matrix2d sum = gramian(form, 3, steps);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(closed[std::size_t(i)], sum(i / 2, i % 2), 1e-12);
    }
  }
}

// 3 d^2 / (2 T^3 (1 - 1/n) (1 - 1/(2n))) for Stormer, 3 d^2 / (2 T^3 (1 - 1/(4n^2))) for midpoint:
// orders 1 and 2 towards 3 d^2 / (2 T^3); the free velocity has no costate at the end.
TEST(Transversality, FreeFinalVelocity) {
  const std::size_t velocity_free[] = {0};
  const double d = 2;
  const double duration = 1.5;
  const double limit = 3 * d * d / (2 * std::pow(duration, 3));
  const auto problem = double_integrator(fixed_state(std::vector<double>{0, 0}),
                                         fixed_components(2, velocity_free, std::vector{d}));
  for (const Discretization form : both_forms) {
    double previous = 0;
    for (const std::size_t steps : {64U, 128U, 256U}) {
      const auto n = static_cast<double>(steps);
      const Solved solved =
          solve(problem, form, duration, shooting(problem, steps, 4, {0, 0}, {0, 0}));
      const bool is_stormer = form == Discretization::stormer;
      const double expected =
          is_stormer ? limit / ((1 - 1 / n) * (1 - 1 / (2 * n))) : limit / (1 - 1 / (4 * n * n));
      EXPECT_NEAR(solved.cost / expected, 1, 1e-13);
      EXPECT_NEAR(solved.solution.trajectory.costates.back()(1), 0, 1e-13);
      const double error = solved.cost - limit;
      if (previous != 0) {
        EXPECT_NEAR(std::log2(previous / error), is_stormer ? 1 : 2, is_stormer ? 0.02 : 1e-4);
      }
      previous = error;
    }
  }
}

// One transfer ends on a line that takes both states; another starts from a line and has a fixed
// end.
TEST(Transversality, EndsOnLines) {
  const int steps = 25;
  for (const Discretization form : both_forms) {
    const auto to_line =
        double_integrator(fixed_state(std::vector<double>{0.5, -1}), on_line(1, 2, 3));
    const Solved to = solve(to_line, form, 2, shooting(to_line, steps, 5, {0.5, -1}, {0, 0}));
    const Eigen::Vector2d c(1, 2);
    const double delta = 3 - c.dot(Eigen::Vector2d(0.5 - 2, -1));
    const Eigen::Matrix2d w = gramian(form, 2, steps);
    EXPECT_NEAR(to.cost, delta * delta / (2 * c.dot(w * c)), 1e-13);
    // The costate at the end is normal to the line.
    const Eigen::VectorXd p = to.solution.trajectory.costates.back();
    EXPECT_NEAR(p(1), 2 * p(0), 1e-13);

    // The motion leads from position - velocity = 1 to the origin: delta = -Phi x_0, x_0 = (1 + v,
    // v), minimised over v; J = delta^T W^-1 delta / 2.
    const auto from_line =
        double_integrator(on_line(1, -1, 1), fixed_state(std::vector<double>{0, 0}));
    const Solved from = solve(from_line, form, 2, shooting(from_line, steps, 5, {1, 0}, {0, 0}));
    Eigen::Matrix2d phi;
    phi << 1, 2, 0, 1;
    const Eigen::Vector2d base = phi * Eigen::Vector2d(1, 0);
    const Eigen::Vector2d along = phi * Eigen::Vector2d(1, 1);
    const Eigen::Matrix2d inverse = w.inverse();
    const double v = -along.dot(inverse * base) / along.dot(inverse * along);
    const Eigen::Vector2d lack = base + v * along;
    EXPECT_NEAR(from.cost, lack.dot(inverse * lack) / 2, 1e-12);
    EXPECT_NEAR(from.solution.trajectory.states.front()(1), v, 1e-12);
    const Eigen::VectorXd p0 = from.solution.trajectory.costates.front();
    EXPECT_NEAR(p0(1), -p0(0), 1e-12);
  }
}

// With phi = x - c the augmented cost says dJ/dc = -lambda, at either end and in both forms; as
// p_n = +lambda_n and p_0 = -lambda_0, dJ/dx_n = -p_n and dJ/dx_0 = p_0. The signs printed for the
// midpoint form would turn those of lambda, and lambda is no longer the derivative.
TEST(Transversality, MultipliersAreMinusTheDerivativesOfTheCost) {
  const int steps = 20;
  for (const Discretization form : both_forms) {
    const Eigen::Vector2d start(0.3, -0.4);
    const Eigen::Vector2d end(1, 0.5);
    const auto problem =
        double_integrator(fixed_state(std::vector<double>(start.begin(), start.end())),
                          fixed_state(std::vector<double>(end.begin(), end.end())));
    const Solved solved = solve(problem, form, 2, shooting(problem, steps, 2, {0.3, -0.4}, {0, 0}));
    Eigen::Matrix2d phi;
    phi << 1, 2, 0, 1;
    // J = delta^T W^-1 delta / 2 with delta = end - Phi start.
    const Eigen::Vector2d by_end = gramian(form, 2, steps).inverse() * (end - phi * start);
    const Eigen::Vector2d by_start = -phi.transpose() * by_end;
    const DiscreteTrajectory& t = solved.solution.trajectory;
    EXPECT_GT(by_end.norm(), 0.5);
    EXPECT_LT((t.final_multipliers + by_end).norm(), 1e-12);
    EXPECT_LT((t.initial_multipliers + by_start).norm(), 1e-12);
    EXPECT_LT((t.costates.back() + by_end).norm(), 1e-12);
    EXPECT_LT((t.costates.front() - by_start).norm(), 1e-12);
  }
}

// A curved end condition, so that the second derivative of phi enters the shooting matrix: from the
// origin of the Heisenberg problem to the cylinder x^2 + y^2 = 4 with free z a radius is shortest.
TEST(Transversality, EndOnACylinder) {
  const auto problem = make_optimal_control_problem(
      "cylinder", 3, 2, HeisenbergFunctions{}, fixed_state(std::vector<double>{0, 0, 0}),
      record(3, [](std::span<const Expression> x) {
        return std::vector<Expression>{x[0] * x[0] + x[1] * x[1] - 4};
      }));
  for (const Discretization form : both_forms) {
    const Solved solved =
        solve(problem, form, 2, shooting(problem, 10, 2, {0, 0, 0}, {-0.7, -0.5, 0.1}));
    EXPECT_NEAR(solved.cost, 1, 1e-14);  // 2^2 / (2 T)
    const DiscreteTrajectory& t = solved.solution.trajectory;
    EXPECT_NEAR(t.costates.back()(2), 0, 1e-14);
    // p_n = 2 x_n lambda with |p_n| = |u| = 1 against the motion.
    EXPECT_NEAR(t.final_multipliers(0), -0.25, 1e-14);
    // Any direction solves the problem.
    EXPECT_EQ(solved.solution.rank, solved.solution.unknowns - 1);
  }
}

}  // namespace
}  // namespace hamjet::test
