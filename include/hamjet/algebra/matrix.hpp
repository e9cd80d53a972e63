#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/eigen.hpp>

namespace hamjet {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// J v of a vector (v_q, v_p) of even length, J = [[0, I], [-I, 0]]: (v_p, -v_q).
template <class T>
Vector<T> symplectic_unit_times(const Vector<T>& v) {
  const Eigen::Index n = v.size() / 2;
  Vector<T> result(v.size());
  result.head(n) = v.tail(n);
  result.tail(n) = -v.head(n);
  return result;
}

}  // namespace hamjet
