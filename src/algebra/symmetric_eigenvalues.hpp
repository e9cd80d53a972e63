#pragma once

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <string_view>

#include "hamjet/error.hpp"

namespace hamjet {

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix, whose lower half alone is read.
/// `what` names the matrix in messages. Throws Error(numerical) if the iteration does not end,
/// which does not happen for finite numbers.
template <class Matrix>
Eigen::SelfAdjointEigenSolver<Matrix> symmetric_eigenvalues(std::string_view what,
                                                            const Matrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: the eigenvalues of a symmetric matrix are not found", what));
  }
  return solver;
}

}  // namespace hamjet
