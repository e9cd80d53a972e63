#pragma once

#include <functional>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// Settings of a damped Newton iteration on equations whose derivative may be rank-deficient.
struct NewtonSettings {
  int most_iterations = 100;
  /// The equations count as solved when the residual is below this fraction of the largest unknown;
  /// the iteration then continues for as long as the residual falls.
  double tolerance = 1e-11;
  /// A direction counts as singular if its pivot is below this fraction of the largest pivot. The
  /// limit is far above round-off, because a direction that is singular at the solution is nearly
  /// singular on the way there.
  double rank_threshold = 1e-8;
  /// Called with the number of the iteration and the largest residual; it may throw to stop.
  std::function<void(int iteration, double residual)> watch = {};
};

/// Linear equations <direction, p_0> = value, one for each column of `directions`, that select one
/// solution of a family. Without them each Newton step is the shortest one, which leads to a member
/// of the family near the start.
struct CostateConditions {
  Eigen::MatrixXd directions;  ///< n x number of conditions
  Eigen::VectorXd values;
};

}  // namespace hamjet
