#pragma once

#include <vector>

#include "flown_deputies.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"

namespace hamjet {

/// Where on the ellipsoids of position and of velocity the single degrees of a flow's polynomials
/// contribute most to the final position.
class SliceMaxima {
 public:
  /// Deputies are told by coordinates along the columns of `axes`, as in FlownDeputies.
  SliceMaxima(const DeputyFlow& flow, const Matrix6& axes);
  /// The final position as polynomials of variables whose derivative by the coordinates is
  /// `variables`.
  SliceMaxima(std::vector<Series<double>> positions, Matrix<double> variables);

  /// Size of the contribution of one degree to the position of a deputy.
  double size(const Vector6& coordinates, int degree);

  /// The distinct deviations at which the contribution of one degree has a local maximum, as far as
  /// ascents from the samples find them, the largest first. All of the largest samples may lie near
  /// a single maximum, while the flown error is larger at another one.
  std::vector<Vector6> maxima(const std::vector<Vector6>& samples, int degree);
  /// The same, and then the samples.
  std::vector<Vector6> maxima_and(const std::vector<Vector6>& samples, int degree);

 private:
  void set_point(const Vector6& coordinates);
  /// Ascent from a sample to a deviation at which the contribution of one degree is largest: the
  /// next point is the direction of the gradient, for position and velocity separately. Random
  /// samples alone would reach only half of the largest value.
  Vector6 worst_from(Vector6 point, int degree);

  /// The contributions of the polynomials to the final position, to first order in the coordinates
  /// at both ends.
  std::vector<Series<double>> positions_;
  Matrix<double> variables_;  ///< the derivative of the polynomials' variables by the coordinates
  MonomialValues values_;
};

}  // namespace hamjet
