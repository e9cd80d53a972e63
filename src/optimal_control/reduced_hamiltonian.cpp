#include "reduced_hamiltonian.hpp"

#include <Eigen/LU>

#include "newton.hpp"

namespace hamjet {

ReducedHamiltonian::ReducedHamiltonian(const OptimalControlProblem& problem)
    : hamiltonian_(control_hamiltonian(problem)), slope_(gradient(control_hamiltonian(problem))) {}

ReducedHamiltonianValue ReducedHamiltonian::evaluate(const Eigen::VectorXd& point,
                                                     const Eigen::VectorXd& control_guess) {
  const Eigen::Index n2 = point.size();
  const Eigen::Index m = control_guess.size();
  std::vector<double> inputs(n2 + m);
  Eigen::Map<Eigen::VectorXd> all(inputs.data(), n2 + m);
  all.head(n2) = point;
  ReducedHamiltonianValue result;
  result.control = control_guess;
  const Linearization stationarity =
      solve_step(result.control, "stationarity in the controls", [&](const Eigen::VectorXd& u) {
        all.tail(m) = u;
        slope_.evaluate(inputs);
        return Linearization{slope_.values().tail(m), slope_.jacobian().bottomRightCorner(m, m)};
      });
  hamiltonian_.evaluate(inputs);
  result.hamiltonian = hamiltonian_.value(0);
  result.gradient = slope_.values().head(n2);
  const Eigen::MatrixXd hessian = slope_.jacobian();
  result.hessian = hessian.topLeftCorner(n2, n2) -
                   hessian.topRightCorner(n2, m) *
                       stationarity.jacobian.partialPivLu().solve(hessian.bottomLeftCorner(m, n2));
  return result;
}

}  // namespace hamjet
