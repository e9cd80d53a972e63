#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string_view>

#include "hamjet/error.hpp"

namespace hamjet {

/// The residual of square equations, and its exact derivative.
struct Linearization {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

/// Solves the equations of one step, `linearize(w)` = 0, by Newton's method from `w`, to round-off,
/// and returns the linearization at the solution. The method is not damped, because the start of a
/// short step is near the solution. Throws Error(numerical) that names `what`.
template <class Linearize>
Linearization solve_step(Eigen::VectorXd& w, std::string_view what, const Linearize& linearize) {
  constexpr int most_iterations = 50;
  // An update whose square is below the rounding of the unknowns, relative to these.
  constexpr double small_update = 1e-8;
  double scale = w.lpNorm<Eigen::Infinity>();
  double update = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Linearization equations = linearize(w);
    const Eigen::VectorXd change = equations.jacobian.partialPivLu().solve(equations.residual);
    w -= change;
    update = change.lpNorm<Eigen::Infinity>();
    if (!w.allFinite()) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: the equations of a step are singular (iteration {})", what,
                              iteration + 1));
    }
    scale = std::max(scale, w.lpNorm<Eigen::Infinity>());
    if (update <= small_update * scale) return linearize(w);
  }
  throw Error(ErrorKind::numerical,
              fmt::format("{}: the equations of a step were not solved in {} iterations (last "
                          "update {:.3g})",
                          what, most_iterations, update));
}

}  // namespace hamjet
