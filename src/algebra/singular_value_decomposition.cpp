#include <Eigen/SVD>

#include "singular_values.hpp"

namespace hamjet {

SingularValueDecomposition decompose_by_singular_values(const Matrix<double>& matrix) {
  const Eigen::JacobiSVD<Matrix<double>> decomposition(matrix,
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

}  // namespace hamjet
