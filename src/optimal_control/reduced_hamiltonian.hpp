#pragma once

#include <cstddef>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "optimal_control_problem.hpp"

namespace hamjet {

/// Value and derivatives of the reduced Hamiltonian at a point.
struct ReducedHamiltonianValue {
  Eigen::VectorXd control;  ///< u(x, p), m
  double hamiltonian = 0;
  Eigen::VectorXd gradient;  ///< with respect to (x, p), 2n
  Eigen::MatrixXd hessian;   ///< 2n x 2n
};

/// Pontryagin's Hamiltonian after elimination of the controls, Hbar(x, p) = H(x, p, u(x, p)) with
/// D3 H(x, p, u(x, p)) = 0. As H is stationary in u, its gradient is that of H at fixed u, and its
/// Hessian is H_zz - H_zu H_uu^-1 H_uz. Source: Guibout and Bloch, eq. barh.
class ReducedHamiltonian {
 public:
  explicit ReducedHamiltonian(const OptimalControlProblem& problem);

  /// Evaluates at (x, p), 2n numbers. Newton's iteration for the controls starts at
  /// `control_guess`. Throws Error(numerical) if D3 H = 0 cannot be solved for the controls.
  ReducedHamiltonianValue evaluate(const Eigen::VectorXd& point,
                                   const Eigen::VectorXd& control_guess);

 private:
  DifferentiableFunction<double> hamiltonian_;  ///< (x, p, u) -> H
  DifferentiableFunction<double> slope_;        ///< (x, p, u) -> grad H
};

}  // namespace hamjet
