#pragma once

#include <vector>

#include "discretization.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "optimal_control_problem.hpp"

namespace hamjet {

/// A solution of the discrete necessary conditions over N steps.
struct DiscreteTrajectory {
  std::vector<Eigen::VectorXd> states;    ///< x_0..x_N, n numbers each
  std::vector<Eigen::VectorXd> costates;  ///< p_0..p_N
  std::vector<Eigen::VectorXd> controls;  ///< u^d of the steps 0..N-1, m numbers each
  Eigen::VectorXd initial_multipliers;    ///< lambda_0, one for each initial condition
  Eigen::VectorXd final_multipliers;      ///< lambda_n, one for each final condition

  std::size_t steps() const noexcept { return controls.size(); }
};

/// The discrete cost, the sum of tau g(x^d, u^d) over the steps. Source: Guibout and Bloch,
/// "Discrete maximum principle".
double discrete_cost(const OptimalControlProblem& problem, Discretization discretization,
                     double step, const DiscreteTrajectory& trajectory);

/// The largest differences between two trajectories of the same size, each relative to the largest
/// magnitude of its kind in the first one (absolute where that is 0).
struct TrajectoryDifference {
  double states = 0;
  double costates = 0;
  double controls = 0;

  double largest() const;
};
/// Compares two trajectories; throws Error(usage) if their numbers of steps differ.
TrajectoryDifference difference(const DiscreteTrajectory& a, const DiscreteTrajectory& b);

}  // namespace hamjet
