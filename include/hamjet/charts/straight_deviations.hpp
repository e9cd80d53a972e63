#pragma once

#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// Deviations from a state along which the coordinates of a chart change linearly. To a linear
/// deviation d in positions and velocities belongs the deviation
///
///   b(d) = phi^-1(phi(x) + phi'(x) d) - x = d + O(d^2) ,
///
/// where phi is the chart and x the state. If d is Gaussian, then the coordinates of x + b(d) are
/// Gaussian with the covariance that the linear map phi' makes of that of d. The chart being
/// canonical, b preserves volumes.
class StraightDeviations {
 public:
  /// About a state, whose coordinates in the chart must be finite.
  StraightDeviations(const CanonicalChart<double>& chart, const SixNumbers<double>& state);

  /// b(d). The numbers are not finite where the coordinates belong to no state.
  Eigen::Matrix<double, 6, 1> operator()(const Eigen::Matrix<double, 6, 1>& linear) const;
  /// b as series in the six components of d, which are the variables of the space.
  std::vector<Series<double>> series(const SpacePointer& space) const;

  const CanonicalChart<double>& chart() const noexcept { return chart_; }
  /// phi'(x): row i is the gradient of coordinate i.
  const Eigen::Matrix<double, 6, 6>& slope() const noexcept { return slope_; }

 private:
  CanonicalChart<double> chart_;
  SixNumbers<double> coordinates_;
  Eigen::Matrix<double, 6, 1> image_;  ///< phi^-1(phi(x)), which is x up to rounding
  Eigen::Matrix<double, 6, 6> slope_;
};

}  // namespace hamjet
