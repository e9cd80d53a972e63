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

/// A covariance matrix that has been looked at: finite, symmetric and positive semidefinite, as far
/// as the digits tell that its numbers were written with.
///
/// The matrix is judged by its correlations, C_ij / (s_i s_j) with the standard deviations s, so
/// that no unit matters. Numbers rounded to p digits are off by up to 5 10^-p of themselves; p is
/// the most digits that one of the numbers needs to be written, at least 4 and at most 15. Of n
/// numbers a row, an eigenvalue of the correlations is off by up to 2 n 5 10^-p: one below the
/// negative of that is none of a covariance, one between that and zero is taken as zero.
class Covariance {
 public:
  /// Throws Error(usage), with `names` for the components (see fault_of), for what is no
  /// covariance.
  explicit Covariance(const Matrix<double>& matrix, const std::array<std::string_view, 6>& names =
                                                        component_names(RelativeFrame::inertial));

  /// The covariance L L^T, positive semidefinite by itself.
  static Covariance of_factor(Matrix<double> factor);
  /// Of independent components with these standard deviations, of which none is below zero.
  static Covariance of_standard_deviations(const Vector<double>& deviations);

  /// What is wrong with a matrix as a covariance, as the end of a message ("not symmetric, got ...,
  /// must be ..."); none if it is one. Components beyond the names are told by number.
  static std::optional<std::string> fault_of(const Matrix<double>& matrix,
                                             const std::array<std::string_view, 6>& names);

  /// Of six numbers that are known exactly.
  Covariance() : factor_(6, 0) {}

  Eigen::Index size() const { return factor_.rows(); }
  /// The number of independent directions: the columns of the factor.
  Eigen::Index rank() const { return factor_.cols(); }
  /// Symmetric, with what is rounding taken out.
  Matrix<double> matrix() const;
  /// L of L L^T = C, size x rank; where it follows from a matrix, its columns are the principal
  /// axes of the correlations, the longest first.
  const Matrix<double>& factor() const { return factor_; }
  /// The square roots of the variances.
  Vector<double> standard_deviations() const;
  /// How far below zero the least eigenvalue of the given correlations was, and set to zero as the
  /// rounding of the digits; 0 where it was above, or of a factor.
  double taken_as_zero() const { return taken_as_zero_; }

  /// The covariance of A x, whose factor is A L. A has `size` columns.
  Covariance mapped(const Matrix<double>& map) const;
  /// The covariance of the sum of two independent vectors of one size.
  Covariance plus(const Covariance& other) const;
  /// The covariance of two independent vectors, one below the other.
  static Covariance of_independent(const Covariance& first, const Covariance& second);

 private:
  Matrix<double> factor_;
  double taken_as_zero_ = 0;
};

/// The 6x6 matrix from relative states in a frame (metres and metres a second, along its axes) to
/// canonical deviations (dq, dp) from the chief along the inertial axes. A covariance of the former
/// becomes one of the latter by `mapped`.
///
/// CCSDS messages give covariances along RTN with inertial velocities: RelativeFrame::rtn_inertial.
Matrix<double> deviations_of_relative_states(const ChiefFrame& frame);
/// The inverse: relative states of canonical deviations.
Matrix<double> relative_states_of_deviations(const ChiefFrame& frame);

}  // namespace hamjet
