#include "hamjet/detail/studies/uncertainty_settings.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace hamjet {

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
