#pragma once

#include <cstddef>
#include <vector>

#include "advance_map.hpp"
#include "discrete_trajectory.hpp"

namespace hamjet {

/// A run of an advance map over several steps, with its Jacobians.
struct Arc {
  std::vector<Eigen::VectorXd> points;     ///< (x, p) at the start and after each step
  std::vector<Eigen::VectorXd> controls;   ///< the control in each step
  std::vector<Eigen::MatrixXd> jacobians;  ///< the Jacobian of each step
  Eigen::MatrixXd jacobian;                ///< Jacobian of the whole arc, 2n x 2n
};

/// Advances (x, p) by `steps` steps; `control_guess`, m numbers, starts the first one. Throws
/// Error(numerical) if a step cannot be solved.
Arc propagate_arc(AdvanceMap& map, const Eigen::VectorXd& point,
                  const Eigen::VectorXd& control_guess, std::size_t steps);

/// Splits the arc's points (x, p) into states and costates; the multipliers are left empty.
DiscreteTrajectory trajectory_of(const Arc& arc);

}  // namespace hamjet
