#include <Eigen/SVD>

#include "hamjet/error.hpp"
#include "singular_values.hpp"

namespace hamjet {

SingularValueDecomposition decompose_by_singular_values(const Matrix<double>& matrix) {
  const Eigen::JacobiSVD<Matrix<double>> decomposition(matrix,
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Where Eigen has no success, its result holds uninitialised memory.
  if (decomposition.info() != Eigen::Success) {
    throw Error(ErrorKind::numerical,
                "singular values: an entry of the matrix is no finite number");
  }
  return {decomposition.matrixU(), decomposition.singularValues(), decomposition.matrixV()};
}

}  // namespace hamjet
