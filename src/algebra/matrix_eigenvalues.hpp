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
  Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
  // Eigen's shifts may go round in circles on matrices of high symmetry, as circular orbits have. A
  // reflection at a plane without symmetry leaves the eigenvalues and removes the symmetry.
  if (solver.info() == Eigen::NoConvergence) {
    const Eigen::Index n = matrix.rows();
    const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(n, 1, static_cast<double>(n)).normalized();
    const Eigen::MatrixXd mirror = Eigen::MatrixXd::Identity(n, n) - 2 * v * v.transpose();
    solver.compute(mirror * matrix * mirror, false);
  }
  // Where Eigen has no success, its result holds uninitialised memory.
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: the eigenvalues of a matrix are not found", what));
  }
  return solver.eigenvalues();
}

}  // namespace hamjet
