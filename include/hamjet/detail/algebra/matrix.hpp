#pragma once

#include <boost/multiprecision/eigen.hpp>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// The product J m for a vector or matrix m of 2n rows, J = [[0, I], [-I, 0]].
template <class Derived>
typename Derived::PlainObject symplectic_unit_times(const Eigen::MatrixBase<Derived>& m) {
  const Eigen::Index n = m.rows() / 2;
  typename Derived::PlainObject result(m.rows(), m.cols());
  result.topRows(n) = m.bottomRows(n);
  result.bottomRows(n) = -m.topRows(n);
  return result;
}

}  // namespace hamjet
