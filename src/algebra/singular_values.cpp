#include "singular_values.hpp"

#include <Eigen/SVD>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"

// These stand in a file of their own because the decompositions take long to compile.

namespace hamjet {

template <class T>
Vector<T> singular_values(const Matrix<T>& matrix) {
  // Pivoting first is for matrices that are not square; to compile it takes longer than all else
  // here.
  if (matrix.rows() != matrix.cols()) {
    throw Error(ErrorKind::usage, "singular values: the matrix must be square");
  }
  return Eigen::JacobiSVD<Matrix<T>, Eigen::NoQRPreconditioner>(matrix).singularValues();
}

SingularValueDecomposition decompose_by_singular_values(const Matrix<double>& matrix) {
  const Eigen::JacobiSVD<Matrix<double>> decomposition(matrix,
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

template Vector<double> singular_values(const Matrix<double>&);
template Vector<Extended> singular_values(const Matrix<Extended>&);

}  // namespace hamjet
