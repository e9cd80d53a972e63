#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace hamjet {

/// The unit vectors along R and T of an orbit.
struct TrackAxes {
  Eigen::Vector3d radial;
  Eigen::Vector3d along;
  double distance = 0;  ///< from the centre

  TrackAxes(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity)
      : distance(position.norm()) {
    radial = position / distance;
    along = (velocity - radial * radial.dot(velocity)).normalized();
  }
  /// The first six numbers are position and velocity.
  explicit TrackAxes(const double* state)
      : TrackAxes(Eigen::Vector3d(state), Eigen::Vector3d(state + 3)) {}
};

/// What is left of a variance if another quantity, of this covariance with it, is known.
inline double variance_beside(double variance, double covariance, double of_known) {
  return std::max(0.0, variance - (of_known > 0 ? covariance * covariance / of_known : 0));
}

}  // namespace hamjet
