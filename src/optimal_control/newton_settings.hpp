#pragma once

#include <functional>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// Settings of a damped Newton iteration on equations whose derivative may be rank-deficient.
struct NewtonSettings {
  int most_iterations = 100;
  /// Largest residual, relative to the largest unknown, at which the equations count as solved; the
  /// iteration then goes on for as long as the residual falls.
  double tolerance = 1e-11;
  /// A direction counts as singular if its pivot is below this fraction of the largest. This is far
  /// above round-off, for a direction that is singular at the solution is nearly so on the way to
  /// it.
  double rank_threshold = 1e-8;
  /// Called with the iteration and the largest residual; may throw to stop.
  std::function<void(int iteration, double residual)> watch = {};
};

/// Linear equations <direction, p_0> = value that pick one solution of a family, a column each.
/// Without them a Newton step is the shortest, which leads to a member near its start.
struct CostateConditions {
  Eigen::MatrixXd directions;  ///< n x number of conditions
  Eigen::VectorXd values;
};

}  // namespace hamjet
