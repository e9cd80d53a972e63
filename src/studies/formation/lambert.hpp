#pragma once

#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// An ellipse from one position to another in a given time about a centre with mu = 1.
struct LambertEllipse {
  Eigen::Vector3d start_velocity;
  double semi_major_axis = 0;
};

/// Lambert's problem: all ellipses (at most two, ordered by period) on which a body moves from one
/// position to another in a time above 0 with this number of whole revolutions. The sense of motion
/// is that of `angular_momentum`, which also gives the plane if the positions lie on a line through
/// the centre. Lancaster and Blanchard's time equation in Izzo's variable, whose roots are
/// bracketed: D. Izzo, Revisiting Lambert's problem, Celestial Mechanics and Dynamical Astronomy
/// 121 (2015).
std::vector<LambertEllipse> lambert_ellipses(const Eigen::Vector3d& first,
                                             const Eigen::Vector3d& last, double time,
                                             int revolutions, const Eigen::Vector3d& momentum);

/// The angle from one position to another about an angular momentum, from 0 to 2 pi.
double angle_about(const Eigen::Vector3d& first, const Eigen::Vector3d& last,
                   const Eigen::Vector3d& momentum);

}  // namespace hamjet
