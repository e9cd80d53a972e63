#include "discrete_maximum_principle.hpp"

#include <Eigen/LU>

#include "newton.hpp"

namespace hamjet {
namespace {

/// The residuals of the discrete necessary conditions of one step.
OperationList necessary_conditions(const OptimalControlProblem& problem,
                                   Discretization discretization, double step) {
  const std::size_t n = problem.states;
  const std::size_t m = problem.controls;
  const OperationList slope = gradient(control_hamiltonian(problem));
  return record(4 * n + m, [&](std::span<const Expression> w) {
    const auto x = w.subspan(0, n);
    const auto p = w.subspan(n, n);
    const auto next_x = w.subspan(2 * n, n);
    const auto next_p = w.subspan(3 * n, n);
    const auto u = w.subspan(4 * n, m);
    std::vector<Expression> discrete_point;
    for (std::size_t i = 0; i < n; ++i) {
      discrete_point.push_back(x[i] + state_weight(discretization) * (next_x[i] - x[i]));
    }
    for (std::size_t i = 0; i < n; ++i) {
      discrete_point.push_back(p[i] + costate_weight(discretization) * (next_p[i] - p[i]));
    }
    discrete_point.insert(discrete_point.end(), u.begin(), u.end());
    const std::vector<Expression> dH = recorded_outputs(slope, discrete_point);
    std::vector<Expression> residuals;
    for (std::size_t i = 0; i < n; ++i) residuals.push_back(next_x[i] - x[i] - step * dH[n + i]);
    for (std::size_t i = 0; i < n; ++i) residuals.push_back(next_p[i] - p[i] + step * dH[i]);
    for (std::size_t i = 0; i < m; ++i) residuals.push_back(dH[2 * n + i]);
    return residuals;
  });
}

}  // namespace

DiscreteMaximumPrinciple::DiscreteMaximumPrinciple(const OptimalControlProblem& problem,
                                                   Discretization discretization, double step)
    : AdvanceMap(problem.states, problem.controls),
      equations_(necessary_conditions(problem, discretization, step)) {}

AdvancedPoint DiscreteMaximumPrinciple::advance(const Eigen::VectorXd& point,
                                                const Eigen::VectorXd& control_guess) {
  const Eigen::Index known = point.size();
  const Eigen::Index unknowns = known + control_guess.size();
  std::vector<double> inputs(known + unknowns);
  Eigen::Map<Eigen::VectorXd> all(inputs.data(), known + unknowns);
  all.head(known) = point;
  Eigen::VectorXd w(unknowns);
  w << point, control_guess;
  const Linearization solved =
      solve_step(w, "discrete maximum principle", [&](const Eigen::VectorXd& trial) {
        all.tail(unknowns) = trial;
        equations_.evaluate(inputs);
        return Linearization{equations_.values(), equations_.jacobian().rightCols(unknowns)};
      });
  // By the implicit function theorem, R_w dw + R_z dz = 0.
  const Eigen::MatrixXd slope =
      -solved.jacobian.partialPivLu().solve(equations_.jacobian().leftCols(known));
  return {w.head(known), w.tail(control_guess.size()), slope.topRows(known)};
}

}  // namespace hamjet
