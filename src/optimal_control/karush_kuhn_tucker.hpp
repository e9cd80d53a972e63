#pragma once

#include <optional>

#include "discrete_trajectory.hpp"
#include "newton_settings.hpp"

namespace hamjet {

/// A solution of the finite-dimensional problem, and how it was reached.
struct KarushKuhnTuckerSolution {
  DiscreteTrajectory trajectory;
  int iterations = 0;
  double residual = 0;  ///< largest component of the gradient of the augmented cost
};

/// The approach "discretise, then optimise": minimises the sum of tau g(x^d, u^d) over all states
/// x_0..x_N and controls u_0..u_(N-1) at once, subject to (x_(k+1) - x_k) / tau = f(x^d, u^d) and
/// both end conditions. Newton's method on the gradient of the augmented cost
///
///   J_a = sum (g - <mu_k, (x_(k+1) - x_k) / tau - f>) tau + <lambda_0, phi_0> + <lambda_n, phi_n>
///
/// with respect to all states, controls and multipliers, with the exact Hessian: a sparse system,
/// solved by LU. No Hamiltonian, advance map or transversality condition is used. Source: Guibout
/// and Bloch, eq. Ja (its sign in the variations is a misprint).
///
/// The costates follow from the multipliers: p_0 = -D phi_0^T lambda_0 and mu_k = p^d. `guess`
/// holds N steps; its multipliers are not used. Throws Error(numerical) that names iteration and
/// residual if it does not converge, or if the solutions form a family from which `conditions` pick
/// none; Error(usage) for sizes that do not fit.
KarushKuhnTuckerSolution solve_karush_kuhn_tucker(
    const OptimalControlProblem& problem, Discretization discretization, double step,
    const DiscreteTrajectory& guess, const NewtonSettings& settings = {},
    const std::optional<CostateConditions>& conditions = std::nullopt);

}  // namespace hamjet
