#pragma once

#include <array>
#include <string_view>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// Position and velocity in inertial axes, in units of the caller's choice.
using OrbitState = std::array<Extended, 6>;

/// Elements of an elliptic orbit that are regular on a circle, though not in the equatorial plane.
/// With the argument of perigee w and the mean anomaly M, they have e cos w, e sin w and u = w + M
/// in place of e, w and M. Angles are in radians.
struct QuasiNonsingularElements {
  Extended semi_major_axis;
  Extended mean_argument_of_latitude;  ///< u
  Extended true_argument_of_latitude;  ///< theta, which follows from the others
  Extended eccentricity_x;             ///< e cos w
  Extended eccentricity_y;             ///< e sin w
  Extended inclination;
  Extended ascending_node;
};

/// The elements of a state. Throws Error(numerical) for orbits that are not elliptic, and for
/// orbits in the equatorial plane or through the centre, which have no node; the message names the
/// satellite.
QuasiNonsingularElements quasi_nonsingular_elements(const OrbitState& state, const Extended& mu,
                                                    std::string_view satellite);

/// The state of elements; the true argument of latitude is not read. Throws Error(numerical) unless
/// a > 0 and e < 1.
///
/// Source: the generalised Kepler equation u = F - e_x sin F + e_y cos F and the closed formulas of
/// the equinoctial elements in the orbit's plane, whose x axis is the line of nodes here; R. A.
/// Broucke and P. J. Cefola, "On the equinoctial orbit elements", Celestial Mechanics 5 (1972).
OrbitState state_from_elements(const QuasiNonsingularElements& elements, const Extended& mu);

/// The true argument of latitude that belongs to the mean one. Throws as state_from_elements.
Extended true_argument_of_latitude(const QuasiNonsingularElements& elements);

/// The mean argument of latitude that belongs to this true one; the mean one among the elements is
/// not read.
Extended mean_argument_of_latitude(const QuasiNonsingularElements& elements);

/// An angle reduced by whole turns to (-pi, pi].
Extended within_half_turn(const Extended& angle);

}  // namespace hamjet
