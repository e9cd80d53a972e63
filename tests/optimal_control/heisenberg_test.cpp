#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "control_problems.hpp"
#include "optimal_control/reduced_hamiltonian.hpp"
#include "support/random_series.hpp"

// The Heisenberg problem. What is expected is the closed forms: the isoperimetric problem's circle
// in continuous time, the regular polygon with steps. Each misprint of the paper's section has a
// test that fails with the printed formula.

namespace hamjet::test {
namespace {

constexpr double pi = std::numbers::pi;

// The sum of tau |u|^2 is 2 n tan(pi/n) |a| / T and |p_z| = (n/T) tan(pi/n): with 1/2 and tau in
// the cost; with the printed sum of <u,u>/2 without tau it would be n / T times as much.
TEST(Heisenberg, LeastCostWithStepsIsThatOfTheRegularPolygon) {
  for (const Discretization form : both_forms) {
    for (const std::size_t steps : {3U, 4U, 7U, 64U, 500U}) {
      for (const auto& [lift, duration] : {std::pair{1.0, 1.0}, {-2.5, 3.0}, {1e6, 0.25}}) {
        const auto n = static_cast<double>(steps);
        const Solved loop = solve_loop(form, lift, duration, steps);
        const double expected = n * std::tan(pi / n) * std::abs(lift) / duration;
        EXPECT_NEAR(loop.cost / expected, 1, 2e-14) << steps << " " << lift;
        const double pz = loop.solution.trajectory.costates.front()(2);
        EXPECT_NEAR(pz * duration / (-std::copysign(n * std::tan(pi / n), lift)), 1, 2e-13);
        EXPECT_NEAR(loop.solution.trajectory.states.back()(2) / lift, 1, 1e-13);
      }
    }
  }
}

// 2 pi |a| / T for the integral of |u|^2, so pi |a| / T for the half; |p_z| = pi / T. The error of
// n tan(pi/n) is pi^3 / (3 n^2): order 2, in Stormer's form too, whose steps enclose exact
// polygons.
TEST(Heisenberg, CostConvergesToTheCircleWithOrderTwo) {
  for (const Discretization form : both_forms) {
    double previous = 0;
    for (const std::size_t steps : {64U, 128U, 256U, 512U}) {
      const Solved loop = solve_loop(form, 2, 0.5, steps, 4);
      const double error = loop.cost - pi * 2 / 0.5;
      EXPECT_GT(error, 0);
      EXPECT_NEAR(loop.solution.trajectory.costates.front()(2) / (-pi / 0.5), 1,
                  4 / static_cast<double>(steps * steps));
      if (previous != 0) {
        EXPECT_NEAR(std::log2(previous / error), 2, 2e-3);
      }
      previous = error;
    }
  }
}

// The printed end point: reached by u = (a/T, 0) at the cost a^2 / (2 T), with z = 0 all along.
TEST(Heisenberg, PrintedEndPointIsReachedByAStraightLine) {
  const auto problem = heisenberg({0, 0, 0}, {3, 0, 0});
  for (const Discretization form : both_forms) {
    const Solved line = solve(problem, form, 2, shooting(problem, 20, 2, {0, 0, 0}, {-1, .5, .5}));
    EXPECT_NEAR(line.cost, 9.0 / 4, 1e-14);
    EXPECT_EQ(line.solution.rank, line.solution.unknowns);
    for (const Eigen::VectorXd& u : line.solution.trajectory.controls) {
      EXPECT_NEAR(u(0), 1.5, 1e-14);
      EXPECT_NEAR(u(1), 0, 1e-14);
    }
  }
}

// The circle through the start may lie in any direction: one singular direction, dx(T)/dp(0) of
// rank 2; with an end point that fixes the direction there is none.
TEST(Heisenberg, PlainShootingOfTheClassicalProblemIsSingular) {
  for (const Discretization form : both_forms) {
    const Solved loop = solve_loop(form, 1, 1, 40);
    EXPECT_EQ(loop.solution.unknowns, 12);
    EXPECT_EQ(loop.solution.rank, 11);
    ASSERT_EQ(loop.solution.family.cols(), 1);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(6, 6);
    for (const Eigen::MatrixXd& jacobian : loop.solution.jacobians) whole = jacobian * whole;
    const Eigen::Vector3d singular = whole.topRightCorner(3, 3).jacobiSvd().singularValues();
    EXPECT_GT(singular(1), 1e-2);
    EXPECT_LT(singular(2), 1e-13);
    // The family turns (p_x, p_y).
    const Eigen::VectorXd p = loop.solution.trajectory.costates.front();
    const Eigen::Vector3d turn = Eigen::Vector3d(-p(1), p(0), 0).normalized();
    EXPECT_NEAR(std::abs(turn.dot(loop.solution.family.col(0))), 1, 1e-9);
  }
}

// u_1 = -(p_x + p_z y), u_2 = -(p_y - p_z x); the print has both with the opposite sign.
TEST(Heisenberg, ControlsHaveTheSignOfStationarity) {
  const Solved loop = solve_loop(Discretization::stormer, 1, 1, 16);
  const DiscreteTrajectory& t = loop.solution.trajectory;
  for (std::size_t k = 0; k < t.steps(); ++k) {
    const Eigen::VectorXd& x = t.states[k];
    const Eigen::VectorXd& p = t.costates[k + 1];
    EXPECT_NEAR(t.controls[k](0), -(p(0) + p(2) * x(1)), 1e-13);
    EXPECT_NEAR(t.controls[k](1), -(p(1) - p(2) * x(0)), 1e-13);
    EXPECT_GT(t.controls[k].norm(), 1);  // so that the opposite sign is not within the tolerance
  }
}

// -(p_x + p_z y)^2/2 - (p_y - p_z x)^2/2; the print loses -p_z^2 (x^2 + y^2)/2.
TEST(Heisenberg, ReducedHamiltonianKeepsTheQuadraticTermInPz) {
  ReducedHamiltonian reduced(heisenberg({0, 0, 0}, {0, 0, 1}));
  RandomNumbers random(5);
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd z(6);
    for (double& value : z) value = random.uniform(-2, 2);
    const double x = z(0), y = z(1), px = z(3), py = z(4), pz = z(5);
    const double expected = -(std::pow(px + pz * y, 2) + std::pow(py - pz * x, 2)) / 2;
    const double printed = -(px * px + py * py) / 2 - px * pz * y + py * pz * x;
    const ReducedHamiltonianValue value = reduced.evaluate(z, Eigen::VectorXd::Zero(2));
    EXPECT_NEAR(value.hamiltonian, expected, 1e-13);
    EXPECT_NEAR(printed - value.hamiltonian, pz * pz * (x * x + y * y) / 2, 1e-13);
  }
}

// Determinant 0 and rank 2 everywhere, the origin included; with the printed Hamiltonian it would
// be x^2 + y^2.
TEST(Heisenberg, MomentumHessianIsSingularEverywhere) {
  ReducedHamiltonian reduced(heisenberg({0, 0, 0}, {0, 0, 1}));
  const auto printed = record(3, [](std::span<const Expression> p) {
    const Expression x = 0.7, y = -1.2;
    return std::vector<Expression>{-(p[0] * p[0] + p[1] * p[1]) / Expression(2) - p[0] * p[2] * y +
                                   p[1] * p[2] * x};
  });
  DifferentiableFunction<double> printed_slope(gradient(printed));
  printed_slope.evaluate(std::vector<double>{0.3, 0.4, 0.5});
  EXPECT_NEAR(printed_slope.jacobian().determinant(), 0.7 * 0.7 + 1.2 * 1.2, 1e-14);
  RandomNumbers random(6);
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd z(6);
    for (double& value : z) value = sample == 0 ? 0 : random.uniform(-2, 2);
    const auto value = reduced.evaluate(z, Eigen::VectorXd::Zero(2));
    const Eigen::Matrix3d hessian = value.hessian.bottomRightCorner(3, 3);
    EXPECT_NEAR(hessian.determinant(), 0, 1e-14);
    const Eigen::Vector3d singular = hessian.jacobiSvd().singularValues();
    EXPECT_GE(singular(1), 1 - 1e-14);
    EXPECT_LE(singular(2), 1e-15 * (1 + singular(0)));
  }
}

// The circle's closed form seen from another start: the problem is invariant under the group's
// translations (x, y, z) -> (x + x0, y + y0, z + z0 + y0 x - x0 y).
TEST(Heisenberg, ClosedFormsAreInvariantUnderTranslations) {
  const std::vector<double> start = {0.5, -1, 2};
  const auto problem = heisenberg(start, {0.5, -1, 3.5});
  const auto expected = heisenberg_cost(start, {0.5, -1., 3.5}, 2, 30);
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->continuous, pi * 1.5 / 2, 1e-14);
  const Solved loop =
      solve(problem, Discretization::midpoint, 2, shooting(problem, 30, 3, start, {-1.6, -.5, -1}));
  EXPECT_NEAR(loop.cost, expected->discrete, 1e-13);
  // A line to (x1, y1) with the z that it brings of itself.
  const auto line = heisenberg_cost(start, {2.5, 0., 2 + -1 * 2 - 0.5 * 1}, 2, 30);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->discrete, 5.0 / 4, 1e-14);
  // No closed form: an end beside the axis, two steps, a free x.
  EXPECT_FALSE(heisenberg_cost(start, {2.5, 0., 7.}, 2, 30));
  EXPECT_FALSE(heisenberg_cost(start, {0.5, -1., 3.5}, 2, 2));
  EXPECT_FALSE(heisenberg_cost(start, {std::nullopt, -1., 3.5}, 2, 30));
}

}  // namespace
}  // namespace hamjet::test
