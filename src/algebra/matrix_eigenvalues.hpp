#pragma once

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <string_view>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// Eigenvalues of a square matrix that need not be symmetric. `what` names it in messages. Throws
/// Error(numerical) if an entry is no finite number, or if the iteration does not end.
inline Eigen::VectorXcd matrix_eigenvalues(std::string_view what, const Matrix<double>& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
  // Without success Eigen leaves its values as the memory was.
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: the eigenvalues of a matrix are not found", what));
  }
  return solver.eigenvalues();
}

}  // namespace hamjet
