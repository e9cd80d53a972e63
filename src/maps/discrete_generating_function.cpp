#include "discrete_generating_function.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/singular_values.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {
namespace {

/// The block that is inverted: the derivative of the chosen final variable by p.
template <class Real>
Matrix<Real> inverted_block(const AffineSymplecticMap<Real>& map,
                            DiscreteGeneratingFunctionKind kind) {
  const Eigen::Index n = map.dimension() / 2;
  return kind == DiscreteGeneratingFunctionKind::first ? map.matrix().topRightCorner(n, n)
                                                       : map.matrix().bottomRightCorner(n, n);
}

}  // namespace

template <class Real>
double existence_measure(const AffineSymplecticMap<Real>& map,
                         DiscreteGeneratingFunctionKind kind) {
  const Vector<Real> values = singular_values(inverted_block(map, kind));
  return static_cast<double>(Real(values(values.size() - 1) / map.matrix().norm()));
}

template <class Real>
bool exists(const AffineSymplecticMap<Real>& map, DiscreteGeneratingFunctionKind kind) {
  const auto precision = static_cast<double>(std::numeric_limits<Real>::epsilon());
  return existence_measure(map, kind) * largest_condition(precision) > 1;
}

template <class Real>
DiscreteGeneratingFunction<Real>::DiscreteGeneratingFunction(const AffineSymplecticMap<Real>& map,
                                                             Kind kind)
    : kind_(kind) {
  const bool is_first = kind == Kind::first;
  if (!exists(map, kind)) {
    throw Error(ErrorKind::numerical,
                fmt::format("discrete generating function of the {} kind: it does not exist: the "
                            "smallest singular value of {} is {:.3g} of the norm of the map",
                            is_first ? "first" : "second", is_first ? "dQ/dp" : "dP/dp",
                            existence_measure(map, kind)));
  }
  // The equations are solved for p from (q, w2), where w2 is the chosen final variable, and then
  // for the other final variable.
  const Eigen::Index n = map.dimension() / 2;
  const auto chosen = [&](const auto& rows) {
    return is_first ? rows.topRows(n) : rows.bottomRows(n);
  };
  const auto other = [&](const auto& rows) {
    return is_first ? rows.bottomRows(n) : rows.topRows(n);
  };
  const Matrix<Real> inverse = inverted_block(map, kind).inverse();
  const Matrix<Real> chosen_by_q = chosen(map.matrix()).leftCols(n);
  const Matrix<Real> other_by_q = other(map.matrix()).leftCols(n);
  const Matrix<Real> other_by_p = other(map.matrix()).rightCols(n);
  const Vector<Real> chosen_shift = chosen(map.shift());
  const Vector<Real> other_shift = other(map.shift());
  const Real sign = is_first ? -1 : 1;  // D2 S = -P, or +Q
  Matrix<Real> one_form(2 * n, 2 * n);
  one_form.topLeftCorner(n, n) = -inverse * chosen_by_q;
  one_form.topRightCorner(n, n) = inverse;
  one_form.bottomLeftCorner(n, n) = (other_by_q - other_by_p * inverse * chosen_by_q) * sign;
  one_form.bottomRightCorner(n, n) = other_by_p * inverse * sign;
  // The matrix is symmetric because A is symplectic; any asymmetry is round-off.
  quadratic_ = (one_form + one_form.transpose()) / Real(2);
  linear_.resize(2 * n);
  linear_.head(n) = -inverse * chosen_shift;
  linear_.tail(n) = (other_shift - other_by_p * inverse * chosen_shift) * sign;
}

template <class Real>
Real DiscreteGeneratingFunction<Real>::value(const Vector<Real>& w) const {
  return w.dot(quadratic_ * w) / Real(2) + linear_.dot(w);
}

template <class Real>
Vector<Real> DiscreteGeneratingFunction<Real>::original_point(const Vector<Real>& w) const {
  const Eigen::Index n = w.size() / 2;
  Vector<Real> z(w.size());
  z.head(n) = w.head(n);
  z.tail(n) = gradient(w).head(n);
  return z;
}

template <class Real>
Vector<Real> DiscreteGeneratingFunction<Real>::transformed_point(const Vector<Real>& w) const {
  const Eigen::Index n = w.size() / 2;
  const Vector<Real> second = gradient(w).tail(n);
  Vector<Real> Z(w.size());
  if (kind_ == Kind::first) {
    Z.head(n) = w.tail(n);
    Z.tail(n) = -second;
  } else {
    Z.head(n) = second;
    Z.tail(n) = w.tail(n);
  }
  return Z;
}

template double existence_measure(const AffineSymplecticMap<InstantiatedReal>&,
                                  DiscreteGeneratingFunctionKind);
template bool exists(const AffineSymplecticMap<InstantiatedReal>&, DiscreteGeneratingFunctionKind);
template class DiscreteGeneratingFunction<InstantiatedReal>;

}  // namespace hamjet
