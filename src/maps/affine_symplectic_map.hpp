#pragma once

#include <limits>

#include "hamjet/detail/algebra/matrix.hpp"

namespace hamjet {

/// How far a 2n x 2n matrix is from symplectic: the largest entry of A J A^T - J.
struct MatrixSymplecticityDefect {
  double absolute = 0;
  double relative =
      0;  ///< divided by the largest entry of |A| |J| |A|^T, the size of the terms that cancel
};

/// The symplecticity defect of a matrix. Throws Error(usage) unless it is 2n x 2n, n > 0.
template <class Real>
MatrixSymplecticityDefect symplecticity_defect(const Matrix<Real>& matrix);

/// The relative defect beyond which a matrix is refused: 1.1e-13 in double precision. A matrix that
/// was formed from others, or written in decimals to the last digit, has a defect well below this.
template <class Real>
double largest_symplecticity_defect() {
  return 512 * static_cast<double>(std::numeric_limits<Real>::epsilon());
}

/// A canonical transformation that is affine in the phase space variables, Z = A z + B with
/// A J A^T = J: one instant f_k of a discrete canonical transformation. Real is double or Extended.
///
/// Source: Guibout and Bloch, section "Discrete canonical transformation".
template <class Real>
class AffineSymplecticMap {
 public:
  /// `matrix` is 2n x 2n, `shift` has 2n entries. Throws Error(usage) for other sizes, entries that
  /// are not finite, or a matrix that is not symplectic; the message states the defect.
  AffineSymplecticMap(Matrix<Real> matrix, Vector<Real> shift);
  /// The linear map without shift, B = 0; throws like the constructor with a shift.
  explicit AffineSymplecticMap(const Matrix<Real>& matrix);

  /// The identity of 2n variables, n = `degrees_of_freedom`.
  static AffineSymplecticMap identity(Eigen::Index degrees_of_freedom);

  const Matrix<Real>& matrix() const { return matrix_; }  ///< A
  const Vector<Real>& shift() const { return shift_; }    ///< B
  Eigen::Index dimension() const { return shift_.size(); }

  /// The matrix A^-1 = -J A^T J, formed without rounding.
  Matrix<Real> inverse_matrix() const;
  /// The inverse map, z = A^-1 (Z - B).
  AffineSymplecticMap inverse() const;
  /// This map after another one: z -> this(first(z)).
  AffineSymplecticMap after(const AffineSymplecticMap& first) const;

  Vector<Real> operator()(const Vector<Real>& z) const { return matrix_ * z + shift_; }

  /// Condition number of A in the Frobenius norm, which for a symplectic matrix is its norm
  /// squared; at least 2n. Coordinates lose about that factor of the precision.
  double condition() const;

 private:
  /// Marks matrices that are symplectic by construction, up to the rounding of products.
  struct Unchecked {};
  AffineSymplecticMap(Unchecked, Matrix<Real> matrix, Vector<Real> shift)
      : matrix_(std::move(matrix)), shift_(std::move(shift)) {}

  Matrix<Real> matrix_;
  Vector<Real> shift_;
};

/// The matrix of the nearest symplectic map to first order, by Newton's iteration: with E = A J A^T
/// - J, which is skew, A + E J A / 2 has a defect of the order E^2. The iteration serves to refine
/// a matrix that is symplectic only to the precision in which it was written.
template <class Real>
Matrix<Real> nearest_symplectic(Matrix<Real> matrix);

/// A rotation of the plane (q, p) of one degree of freedom:
/// [[cos, -sin], [sin, cos]] of the angle (radians).
template <class Real>
AffineSymplecticMap<Real> phase_plane_rotation(const Real& angle);

}  // namespace hamjet
