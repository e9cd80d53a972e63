#include "hamjet/detail/studies/uncertainty_settings.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace hamjet {

Matrix<double> StateUncertainty::joint_matrix() const {
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Matrix<double> matrix = Matrix<double>::Zero(6 + count, 6 + count);
  matrix.topLeftCorner(6, 6) = covariance.matrix();
  for (Eigen::Index k = 0; k < count; ++k) {
    const UncertainParameter& parameter = parameters[static_cast<std::size_t>(k)];
    const Eigen::Index row = 6 + k;
    for (std::size_t j = 0; j < parameter.covariances.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      matrix(row, column) = matrix(column, row) = parameter.covariances[j];
    }
    matrix(row, row) = parameter.deviation * parameter.deviation;
  }
  return matrix;
}

Covariance BurnUncertainty::covariance() const {
  const double size = velocity_change_m_s.norm();
  Matrix<double> factor = Matrix<double>::Zero(6, 3);
  if (size == 0) return Covariance::of_factor(factor);
  const Eigen::Vector3d along = velocity_change_m_s / size;
  const Eigen::Vector3d across = along.unitOrthogonal();
  const double angle = direction_deg * std::numbers::pi / 180;
  factor.block<3, 1>(3, 0) = magnitude * size * along;
  factor.block<3, 1>(3, 1) = angle * size * across;
  factor.block<3, 1>(3, 2) = angle * size * along.cross(across);
  return Covariance::of_factor(std::move(factor));
}

}  // namespace hamjet
