#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// How the state of a deputy relative to its chief is written. RTN has the axes
///
///   R = r / |r|,   N = r x v / |r x v|,   T = N x R
///
/// of the chief's state: radial, transverse (along the motion; parallel to the velocity only on a
/// circular orbit) and normal.
enum class RelativeFrame {
  rtn_rotating,  ///< along RTN; velocities are derivatives seen from the rotating axes
  rtn_inertial,  ///< along RTN; velocities are differences of inertial velocities
  inertial,      ///< along the inertial axes of the orbit
  coordinates,   ///< along the coordinates of a system without an orbit; velocities are their rates
};

/// Whether the axes are those of the positions themselves, so that there is no orbital plane.
inline bool is_along_coordinates(RelativeFrame frame) {
  return frame == RelativeFrame::inertial || frame == RelativeFrame::coordinates;
}

/// A deputy's state relative to its chief, in one of the frames.
struct RelativeState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
};

/// How the rates of the coordinates follow from coordinates and momenta, where this is linear:
/// dq' = W dp + G dq, in canonical units. Of an orbit, where momenta are velocities, W = 1 and
/// G = 0; of coordinates that turn at the rate w about the third axis G = w (0 1 0, -1 0 0, 0 0 0).
struct VelocityLaw {
  Eigen::Matrix3d by_momenta = Eigen::Matrix3d::Identity();  ///< W, which has an inverse
  Eigen::Matrix3d by_positions = Eigen::Matrix3d::Zero();    ///< G
};

/// SI values of the canonical units in which deviations are computed, and what a velocity is.
struct MetricUnits {
  double length_m = 1;
  double time_s = 1;
  VelocityLaw velocities = {};  ///< used along RelativeFrame::coordinates alone

  double velocity_m_s() const { return length_m / time_s; }
};

/// A frame at one instant: it converts between relative states and the canonical deviations (dq,
/// dp) from the chief, dp being the difference of the inertial velocities; along coordinates it is
/// that of the momenta, which VelocityLaw makes of rates.
///
/// The rotating axes turn at the rate of the chief's osculating Kepler orbit,
///
///   omega = |r x v| / r^2  about N ;
///
/// omega leaves out the slow turn of the orbit's plane by perturbing forces. With rho and rho' the
/// position and velocity in rotating axes, the inertial velocity along them is rho' + omega N x
/// rho. Source: Schaub and Junkins, Analytical Mechanics of Space Systems, chapter "Spacecraft
/// Formation Flying".
class ChiefFrame {
 public:
  /// `chief` is the inertial state (q, p), 6 canonical numbers, perhaps followed by parameters.
  /// Throws Error(numerical) for RTN if the chief moves on a line through the centre, where there
  /// is no orbital plane, and Error(usage) for other sizes.
  ChiefFrame(std::span<const double> chief, const MetricUnits& units, RelativeFrame frame);

  /// The canonical deviation (dq, dp) of a relative state, 6 numbers.
  std::vector<double> deviation(const RelativeState& state) const;
  /// The relative state of a canonical deviation (dq, dp), the first 6 numbers.
  RelativeState relative(std::span<const double> deviation) const;

  /// A velocity change, m/s along the frame's axes, from the canonical change of the momenta at one
  /// place. It is the same for rotating and inertial derivatives.
  Eigen::Vector3d velocity_change_m_s(const Eigen::Vector3d& canonical) const;
  /// The components along the frame's axes of a vector given in inertial axes.
  Eigen::Vector3d along_axes(const Eigen::Vector3d& inertial) const { return axes_ * inertial; }

 private:
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  ///< rows: the frame's axes
  /// Velocities along the axes are to_velocity_ dp + turn_ dq of deviations along them, canonical.
  Eigen::Matrix3d to_velocity_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d to_momentum_ = Eigen::Matrix3d::Identity();  ///< the inverse
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Zero();
  MetricUnits units_;
};

}  // namespace hamjet
