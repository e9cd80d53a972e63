#include "singular_values.hpp"

#include <Eigen/SVD>

#include "hamjet/algebra/extended.hpp"

// These stand in a file of their own because the decompositions take long to compile.

namespace hamjet {

template <class T>
Vector<T> singular_values(const Matrix<T>& matrix) {
  return Eigen::JacobiSVD<Matrix<T>>(matrix).singularValues();
}

SingularValueDecomposition decompose_by_singular_values(const Matrix<double>& matrix) {
  const Eigen::JacobiSVD<Matrix<double>> decomposition(matrix,
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

template Vector<double> singular_values(const Matrix<double>&);
template Vector<Extended> singular_values(const Matrix<Extended>&);

}  // namespace hamjet
