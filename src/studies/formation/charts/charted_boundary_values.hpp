#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/maps/position_boundary_values.hpp"

namespace hamjet {

/// The derivative of the final position by the initial momentum, by polynomials up to a degree,
/// from central differences in one block of deputies. The step leaves some ten digits.
Eigen::Matrix3d commanded_positions(DeputyPredictor& predictor, const SixNumbers<double>& deviation,
                                    int degree);

/// Solves two-point problems in positions by the polynomials of one flow in any coordinates. It
/// corresponds to PositionBoundaryValues for Cartesian jets, but uses no generating function.
///
/// Newton's method is applied to the predicted final position; a step that does not come nearer is
/// halved. The matrix is kept from one step, degree and problem to the next, and corrected by
/// Broyden's update after each step. It is made anew from differences of predictions when a step
/// reduces the miss too little. Most problems thus cost one prediction per step.
///
/// Source: C. G. Broyden, A class of methods for solving nonlinear simultaneous equations, Math.
/// Comp. 19 (1965) 577.
class ChartedBoundaryValues {
 public:
  /// The flow must outlive this object.
  explicit ChartedBoundaryValues(const DeputyFlow& flow) : predictor_(flow) {}

  /// `first` and `last` are deviations of the positions at both ends, `guess` is a deviation of the
  /// initial momentum; all are canonical. Throws Error(numerical) if no solution is found from
  /// there.
  BoundaryMomenta solve(std::span<const double> first, std::span<const double> last, int degree,
                        std::span<const double> guess);

 private:
  DeputyPredictor predictor_;
  std::optional<Eigen::Matrix3d> commanded_;  ///< matrix at the last problem's solution
};

}  // namespace hamjet
