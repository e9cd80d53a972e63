#include "singular_values.hpp"

#include <Eigen/SVD>
#include <limits>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "instantiated_real.hpp"

// This stands in a file of its own because the decomposition takes long to compile.

namespace hamjet {

template <class T>
Vector<T> singular_values(const Matrix<T>& matrix) {
  // Pivoting first is meant for matrices that are not square, and would take longer to compile than
  // the rest of this file.
  if (matrix.rows() != matrix.cols()) {
    throw Error(ErrorKind::usage, "singular values: the matrix must be square");
  }
  const Eigen::JacobiSVD<Matrix<T>, Eigen::NoQRPreconditioner> decomposition(matrix);
  // Where Eigen has no success, its result holds uninitialised memory.
  if (decomposition.info() != Eigen::Success) {
    return Vector<T>::Constant(matrix.rows(), std::numeric_limits<T>::quiet_NaN());
  }
  return decomposition.singularValues();
}

template Vector<InstantiatedReal> singular_values(const Matrix<InstantiatedReal>&);

}  // namespace hamjet
