#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <cmath>

namespace hamjet {

/// Factors by which the rows and columns of a matrix are multiplied so that the largest entry of
/// each is near 1. Ranks and norms then do not depend on the units of unknowns and equations.
struct Equilibration {
  Eigen::VectorXd rows;
  Eigen::VectorXd columns;
};

/// Ruiz's iteration for dense and sparse matrices: rows and columns are divided by the square roots
/// of their largest entries, a few times. Rows and columns of zeros keep the factor 1.
template <class Matrix>
Equilibration equilibrate(const Matrix& matrix) {
  constexpr int sweeps = 8;
  Equilibration scale{Eigen::VectorXd::Ones(matrix.rows()), Eigen::VectorXd::Ones(matrix.cols())};
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(matrix.rows());
    Eigen::VectorXd columns = Eigen::VectorXd::Zero(matrix.cols());
    for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
      for (Eigen::InnerIterator<Matrix> entry(matrix, j); entry; ++entry) {
        const double size =
            std::abs(entry.value()) * scale.rows(entry.row()) * scale.columns(entry.col());
        rows(entry.row()) = std::max(rows(entry.row()), size);
        columns(entry.col()) = std::max(columns(entry.col()), size);
      }
    }
    const auto divide = [](double factor, double largest) {
      return largest > 0 ? factor / std::sqrt(largest) : factor;
    };
    scale.rows = scale.rows.binaryExpr(rows, divide).eval();
    scale.columns = scale.columns.binaryExpr(columns, divide).eval();
  }
  return scale;
}

}  // namespace hamjet
