#include "hamiltonian_discretization.hpp"

#include <Eigen/LU>

#include "hamjet/detail/algebra/matrix.hpp"
#include "newton.hpp"

namespace hamjet {

HamiltonianDiscretization::HamiltonianDiscretization(const OptimalControlProblem& problem,
                                                     Discretization discretization, double step)
    : AdvanceMap(problem.states, problem.controls),
      hamiltonian_(problem),
      step_(step),
      weights_(2 * problem.states) {
  weights_ << Eigen::VectorXd::Constant(problem.states, state_weight(discretization)),
      Eigen::VectorXd::Constant(problem.states, costate_weight(discretization));
}

AdvancedPoint HamiltonianDiscretization::advance(const Eigen::VectorXd& point,
                                                 const Eigen::VectorXd& control_guess) {
  const Eigen::Index n2 = point.size();
  ReducedHamiltonianValue value;
  value.control = control_guess;
  Eigen::VectorXd next = point;
  const Linearization solved =
      solve_step(next, "discretised canonical equations", [&](const Eigen::VectorXd& trial) {
        value = hamiltonian_.evaluate(point + weights_.cwiseProduct(trial - point), value.control);
        const Eigen::MatrixXd slope = step_ * symplectic_unit_times(value.hessian);
        return Linearization{trial - point - step_ * symplectic_unit_times(value.gradient),
                             Eigen::MatrixXd::Identity(n2, n2) - slope * weights_.asDiagonal()};
      });
  const Eigen::VectorXd own_weights = Eigen::VectorXd::Ones(n2) - weights_;
  const Eigen::MatrixXd by_point =
      Eigen::MatrixXd::Identity(n2, n2) +
      step_ * symplectic_unit_times(value.hessian) * own_weights.asDiagonal();
  return {next, value.control, solved.jacobian.partialPivLu().solve(by_point)};
}

}  // namespace hamjet
