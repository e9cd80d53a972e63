#pragma once

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string_view>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// Eigenvalues of a square matrix that need not be symmetric. `what` names it in messages. Throws
/// Error(numerical) if an entry is no finite number, or if the iteration does not end.
inline Eigen::VectorXcd matrix_eigenvalues(std::string_view what, const Matrix<double>& matrix) {
  Eigen::MatrixXd turned = matrix;
  Eigen::EigenSolver<Eigen::MatrixXd> solver;
  // Of a matrix with eigenvalues of one size, such as the field's beside a circle, the iteration
  // may go round in a circle. It does not in axes that a reflection has turned.
  constexpr int most_trials = 4;
  for (int trial = 0; trial < most_trials && turned.allFinite(); ++trial) {
    solver.compute(turned, false);
    // Without success Eigen leaves its values as the memory was.
    if (solver.info() == Eigen::Success) return solver.eigenvalues();
    Eigen::VectorXd normal(turned.rows());
    for (Eigen::Index i = 0; i < normal.size(); ++i) {
      normal[i] = std::sin(static_cast<double>(trial + 1 + i * i));
    }
    normal.normalize();
    turned -= 2 * normal * (normal.transpose() * turned).eval();
    turned -= 2 * (turned * normal).eval() * normal.transpose();
  }
  throw Error(ErrorKind::numerical,
              fmt::format("{}: the eigenvalues of a matrix are not found", what));
}

}  // namespace hamjet
