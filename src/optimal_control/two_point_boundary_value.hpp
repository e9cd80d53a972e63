#pragma once

#include <cstddef>
#include <optional>

#include "arc.hpp"
#include "end_conditions.hpp"
#include "newton_settings.hpp"

namespace hamjet {

/// The start of multiple shooting: the trajectory that a first state and costate lead to.
struct ShootingSettings {
  std::size_t steps = 1;
  std::size_t intervals = 1;      ///< number of intervals, 1..steps; 1 is plain shooting
  Eigen::VectorXd state_guess;    ///< n
  Eigen::VectorXd costate_guess;  ///< n
  Eigen::VectorXd control_guess;  ///< m
  /// Typical sizes, n positive numbers each, in units of which residuals and ranks are measured; if
  /// empty, all are 1. If the product of each state's and costate's size is the same (that of the
  /// cost), the solution does not depend on the units.
  Eigen::VectorXd typical_state = {};
  Eigen::VectorXd typical_costate = {};
  NewtonSettings newton;
  std::optional<CostateConditions> conditions;
};

/// A solution of the two-point boundary-value problem.
struct ShootingSolution {
  DiscreteTrajectory trajectory;
  std::vector<Eigen::MatrixXd> jacobians;  ///< the Jacobian of each step's map
  int iterations = 0;
  double residual = 0;        ///< largest residual after the last iteration
  Eigen::Index unknowns = 0;  ///< 2n for each interval, plus the number of multipliers
  Eigen::Index rank = 0;      ///< rank of the shooting matrix at the solution, without conditions
  /// An orthonormal basis of the initial costates' directions along the family of solutions, n x
  /// nullity; no columns where the solution is isolated.
  Eigen::MatrixXd family;
};

/// Solves the discrete necessary conditions with both end conditions and the transversality
/// conditions by multiple shooting. The unknowns are (x, p) at the start of each interval and the
/// multipliers of both ends. The equations are phi_0 = 0, p_0 + D phi_0^T lambda_0 = 0, the
/// continuity from interval to interval, phi_n = 0 and p_n - D phi_n^T lambda_n = 0. Each Newton
/// step is the shortest one (complete orthogonal decomposition), so that a problem whose solutions
/// form a family converges to one of them. Jacobians are exact.
///
/// Throws Error(usage) for sizes that do not fit, Error(numerical) that names iteration, residual
/// and rank if it does not converge.
ShootingSolution solve_by_shooting(AdvanceMap& map, const OptimalControlProblem& problem,
                                   const ShootingSettings& settings);

}  // namespace hamjet
