#pragma once

#include "affine_symplectic_map.hpp"

namespace hamjet {

/// The kind of a discrete generating function: S(q, Q) is the first, S(q, P) the second.
enum class DiscreteGeneratingFunctionKind { first, second };

/// The smallest singular value of the block that a kind inverts (dQ/dp or dP/dp), relative to the
/// norm of the whole matrix. Round-off is divided by this number; where no digits are left, the
/// kind does not exist.
template <class Real>
double existence_measure(const AffineSymplecticMap<Real>& map, DiscreteGeneratingFunctionKind kind);

/// Whether a kind exists to the precision of Real; see largest_condition.
template <class Real>
bool exists(const AffineSymplecticMap<Real>& map, DiscreteGeneratingFunctionKind kind);

/// A discrete generating function of an affine canonical transformation (q, p) -> (Q, P), at one
/// instant: a quadratic function of w = (q, Q) or w = (q, P),
///
///   S(w) = w^T T w / 2 + U^T w,   grad S = T w + U ,
///
/// up to a constant. With dS = p dq - P dQ, or dS = p dq + Q dP,
///
///   first kind:   p = D1 S(q, Q),  P = -D2 S(q, Q);
///   second kind:  p = D1 S(q, P),  Q =  D2 S(q, P).
///
/// With A = [[a, b], [c, d]] and B = (e, g), from Q = a q + b p + e, P = c q + d p + g:
///
///   first kind:   T = [[-b^-1 a, b^-1], [b^-T, -d b^-1]],      U = (-b^-1 e, d b^-1 e - g);
///   second kind:  T = [[-d^-1 c, d^-1], [d^-T, b d^-1]],       U = (-d^-1 g, e - b d^-1 g).
///
/// Source: Guibout and Bloch, section "Discrete generating functions" (in print S is called linear,
/// and the second kind is written S(q, Q)).
template <class Real>
class DiscreteGeneratingFunction {
 public:
  using Kind = DiscreteGeneratingFunctionKind;

  /// Throws Error(numerical) where the kind does not exist, see `exists`. The message names kind
  /// and singular value.
  DiscreteGeneratingFunction(const AffineSymplecticMap<Real>& map, Kind kind);

  Kind kind() const { return kind_; }
  const Matrix<Real>& quadratic_part() const { return quadratic_; }  ///< T, symmetric
  const Vector<Real>& linear_part() const { return linear_; }        ///< U

  /// The value S(w); w has 2n entries.
  Real value(const Vector<Real>& w) const;
  /// The gradient (D1 S, D2 S) at w, 2n entries.
  Vector<Real> gradient(const Vector<Real>& w) const { return quadratic_ * w + linear_; }

  /// The point z = (q, p) that S relates to transformed_point(w).
  Vector<Real> original_point(const Vector<Real>& w) const;
  /// The point Z = (Q, P) that S relates to original_point(w).
  Vector<Real> transformed_point(const Vector<Real>& w) const;

 private:
  Kind kind_;
  Matrix<Real> quadratic_;
  Vector<Real> linear_;
};

}  // namespace hamjet
