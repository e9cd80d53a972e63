#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/maps/position_boundary_values.hpp"

namespace hamjet {

/// The derivative of the final position by the initial momentum that polynomials up to a degree
/// say, by central differences in one block of deputies. The step leaves some ten digits.
Eigen::Matrix3d commanded_positions(DeputyPredictor& predictor, const SixNumbers<double>& deviation,
                                    int degree);

/// Solves two-point problems in positions by the polynomials of one flow in any coordinates. What
/// PositionBoundaryValues does for Cartesian jets, with no generating function in between.
///
/// Newton's method on the final position that they predict, halved where it does not come nearer.
/// Its matrix is kept from one step, one degree and one problem to the next, and follows by
/// Broyden's update from what each step has changed; differences of predictions make it anew where
/// a step gains less than a quarter. So a prediction a step is what most problems cost.
///
/// Source: C. G. Broyden, A class of methods for solving nonlinear simultaneous equations, Math.
/// Comp. 19 (1965) 577.
class ChartedBoundaryValues {
 public:
  /// The flow must outlive it.
  explicit ChartedBoundaryValues(const DeputyFlow& flow) : predictor_(flow) {}

  /// `first` and `last` are deviations of the positions at both ends, `guess` one of the initial
  /// momentum; all canonical. Throws Error(numerical) if no solution is found from there.
  BoundaryMomenta solve(std::span<const double> first, std::span<const double> last, int degree,
                        std::span<const double> guess);

 private:
  DeputyPredictor predictor_;
  std::optional<Eigen::Matrix3d> commanded_;  ///< of the last problem's solution
};

}  // namespace hamjet
