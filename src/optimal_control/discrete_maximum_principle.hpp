#pragma once

#include "advance_map.hpp"
#include "discretization.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "optimal_control_problem.hpp"

namespace hamjet {

/// The discrete maximum principle: with H_d = g + <p, f>,
///
///   (x_(k+1) - x_k) / tau = D2 H_d(x^d, p^d, u^d) ,
///   (p_(k+1) - p_k) / tau = -D1 H_d(x^d, p^d, u^d) ,   0 = D3 H_d(x^d, p^d, u^d) .
///
/// States, costates and controls of a step are solved for together by Newton; the Jacobian of the
/// map follows from the derivatives of these equations at the solution. Source: Guibout and Bloch,
/// eqs. dsneccond1..3 (Stormer) and dneccond1_mp..3 (midpoint; R_(tau/2) - R_(-tau/2) divided by
/// tau).
class DiscreteMaximumPrinciple : public AdvanceMap {
 public:
  DiscreteMaximumPrinciple(const OptimalControlProblem& problem, Discretization discretization,
                           double step);

  AdvancedPoint advance(const Eigen::VectorXd& point,
                        const Eigen::VectorXd& control_guess) override;

 private:
  DifferentiableFunction<double>
      equations_;  ///< (x_k, p_k, x_(k+1), p_(k+1), u) -> 2n + m residuals
};

}  // namespace hamjet
