#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// The names of position and velocity along a frame's axes: R, T, N, vR, vT, vN, or x, y, z, vx,
/// vy, vz.
std::array<std::string_view, 6> component_names(RelativeFrame frame);

/// A checked covariance matrix: finite, symmetric and positive semidefinite, as far as this can be
/// judged from the digits with which its numbers were written.
///
/// The matrix is judged by its correlations, C_ij / (s_i s_j) with the standard deviations s, so
/// that no unit matters. A number rounded to p digits has a relative error of up to 5 10^-p; p is
/// the largest number of digits that any of the numbers needs, at least 4 and at most 15. With n
/// numbers in a row, an eigenvalue of the correlations then has an error of up to 2 n 5 10^-p. A
/// matrix with an eigenvalue below the negative of this error is refused; an eigenvalue between
/// that and zero is taken as zero.
class Covariance {
 public:
  /// Throws Error(usage), with `names` for the components (see fault_of), if the matrix is not a
  /// covariance.
  explicit Covariance(const Matrix<double>& matrix, const std::array<std::string_view, 6>& names =
                                                        component_names(RelativeFrame::inertial));

  /// The covariance L L^T, which is positive semidefinite by construction.
  static Covariance of_factor(Matrix<double> factor);
  /// The covariance of independent components with these standard deviations, none of which may be
  /// negative.
  static Covariance of_standard_deviations(const Vector<double>& deviations);

  /// The reason why a matrix is not a covariance, as the end of a message ("not symmetric, got ...,
  /// must be ..."); no value if it is one. Components beyond the names are named by number.
  static std::optional<std::string> fault_of(const Matrix<double>& matrix,
                                             const std::array<std::string_view, 6>& names);

  /// The covariance of six numbers that are known exactly.
  Covariance() : factor_(6, 0) {}

  Eigen::Index size() const { return factor_.rows(); }
  /// The number of independent directions, which is the number of columns of the factor.
  Eigen::Index rank() const { return factor_.cols(); }
  /// The matrix, made symmetric, with negative eigenvalues that are rounding set to zero.
  Matrix<double> matrix() const;
  /// The factor L of C = L L^T, size x rank. If it was made from a matrix, its columns are the
  /// principal axes of the correlations, the longest first.
  const Matrix<double>& factor() const { return factor_; }
  /// The square roots of the variances.
  Vector<double> standard_deviations() const;
  /// How far below zero the least eigenvalue of the given correlations was, if it was set to zero
  /// as rounding of the digits; 0 if it was not negative, and for a covariance made from a factor.
  double taken_as_zero() const { return taken_as_zero_; }

  /// The covariance of A x, whose factor is A L. The matrix A has `size` columns.
  Covariance mapped(const Matrix<double>& map) const;
  /// The covariance of the sum of two independent vectors of one size.
  Covariance plus(const Covariance& other) const;
  /// The covariance of two independent vectors, stacked into one.
  static Covariance of_independent(const Covariance& first, const Covariance& second);

 private:
  Matrix<double> factor_;
  double taken_as_zero_ = 0;
};

/// The 6x6 matrix that takes relative states in a frame (metres and metres per second, along its
/// axes) to canonical deviations (dq, dp) from the chief along the inertial axes. `mapped` by this
/// matrix takes a covariance of the former to one of the latter.
///
/// CCSDS messages give covariances along RTN with inertial velocities, which is
/// RelativeFrame::rtn_inertial.
Matrix<double> deviations_of_relative_states(const ChiefFrame& frame);
/// The inverse matrix, from canonical deviations to relative states.
Matrix<double> relative_states_of_deviations(const ChiefFrame& frame);

}  // namespace hamjet
