#include "quadrature.hpp"

#include <cmath>

#include "../../algebra/symmetric_eigenvalues.hpp"

namespace hamjet {

NormalQuadrature product_quadrature(const std::vector<int>& nodes) {
  NormalQuadrature result{Matrix<double>(0, 1), Vector<double>::Ones(1)};
  for (const int n : nodes) {
    Matrix<double> recurrence = Matrix<double>::Zero(n, n);
    for (int k = 1; k < n; ++k) {
      recurrence(k, k - 1) = recurrence(k - 1, k) = std::sqrt(static_cast<double>(k));
    }
    const auto solver = symmetric_eigenvalues("quadrature", recurrence);
    const Eigen::Index count = result.weights.size();
    NormalQuadrature next{Matrix<double>(result.points.rows() + 1, count * n),
                          Vector<double>(count * n)};
    for (int k = 0; k < n; ++k) {
      const double first = solver.eigenvectors()(0, k);
      next.points.block(0, k * count, result.points.rows(), count) = result.points;
      next.points.block(result.points.rows(), k * count, 1, count)
          .setConstant(solver.eigenvalues()[k]);
      next.weights.segment(k * count, count) = first * first * result.weights;
    }
    result = std::move(next);
  }
  return result;
}

}  // namespace hamjet
