#pragma once

#include "hamjet/detail/algebra/matrix.hpp"

namespace hamjet {

/// Singular values of a square matrix, the largest first; T is double or Extended. All are NaN if
/// an entry is no finite number. Throws Error(usage) if the matrix is not square.
template <class T>
Vector<T> singular_values(const Matrix<T>& matrix);

/// The decomposition A = left diag(values) right^T with square orthogonal `left` and `right`, the
/// largest value first. Throws Error(numerical) if an entry is no finite number.
struct SingularValueDecomposition {
  Matrix<double> left;
  Vector<double> values;
  Matrix<double> right;
};
SingularValueDecomposition decompose_by_singular_values(const Matrix<double>& matrix);

}  // namespace hamjet
