#pragma once

#include <array>
#include <optional>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// Osculating Kepler elements of an elliptic orbit: the ellipse on which the body would go on if
/// every force but the central one vanished at that instant.
struct OsculatingElements {
  Extended semi_major_axis_km = 0;       ///< a > 0
  Extended eccentricity = 0;             ///< e in [0, 1)
  Extended inclination_deg = 0;          ///< i, from the equatorial plane
  Extended ascending_node_deg = 0;       ///< right ascension of the ascending node, from the x axis
  Extended argument_of_perigee_deg = 0;  ///< from the ascending node, along the motion
  Extended true_anomaly_deg = 0;         ///< from perigee, along the motion
};

/// Cartesian state in the inertial axes x, y (equatorial plane) and z (north).
struct CartesianState {
  std::array<Extended, 3> position_km;
  std::array<Extended, 3> velocity_km_s;
};

/// Sine and cosine of one angle.
struct SineCosine {
  Extended sine;
  Extended cosine;
};

/// Sine and cosine of an angle in degrees (any finite value). The angle is reduced exactly to at
/// most 45 degrees before it is converted to radians, so that multiples of 90 degrees give exactly
/// 0, 1 or -1.
SineCosine sine_cosine_of_degrees(const Extended& angle_deg);

/// State of a body with the given elements about a centre of gravitational parameter `mu_km3_s2`.
/// The elements count as exact; the result is good to about 33 digits. Components that vanish
/// because angles are multiples of 90 degrees are exactly +0: z and its velocity for i = 0, y and
/// its velocity for i = 90 and node 0.
///
/// Throws Error(usage) unless a > 0, 0 <= e < 1, mu > 0 and every number is finite.
///
/// Source: D. A. Vallado, Fundamentals of Astrodynamics and Applications, 4th ed. (2013), section
/// 2.6 (algorithm COE2RV), its rotation written out with the argument of latitude.
CartesianState state_from_elements(const OsculatingElements& elements, double mu_km3_s2);

/// The elements of a state: the inverse of state_from_elements, with angles from 0 to 360 degrees
/// and the inclination from 0 to 180. In the equatorial plane the x axis takes the place of the
/// node, so that the node's angle is 0; on a circle the node takes the place of the perigee, whose
/// argument is 0.
///
/// Throws Error(usage) unless mu > 0 and every number is finite; Error(numerical) where the orbit
/// is no ellipse.
///
/// Source: Vallado, the same section (algorithm RV2COE), angles by two-argument arctangents.
OsculatingElements elements_from_state(const CartesianState& state, double mu_km3_s2);

/// Eccentric anomaly E that belongs to a mean anomaly M on an ellipse, by Kepler's equation M = E -
/// e sin E, good to about 33 digits. E is on the same turn as M. Multiples of 180 degrees, and all
/// angles where e = 0, stay as they are.
///
/// Throws Error(usage) unless 0 <= e < 1 and the anomaly is finite.
///
/// Source: D. A. Vallado, Fundamentals of Astrodynamics and Applications, 4th ed. (2013), section
/// 2.2 (algorithm KepEqtnE), with a bracket about Newton's steps.
Extended eccentric_anomaly_of_mean_deg(const Extended& mean_anomaly_deg,
                                       const Extended& eccentricity);

/// True anomaly that belongs to an eccentric anomaly on an ellipse, good to about 33 digits. It is
/// on the same turn as the eccentric anomaly. Multiples of 180 degrees, and all angles where e = 0,
/// stay as they are.
///
/// Throws Error(usage) unless 0 <= e < 1 and the anomaly is finite.
///
/// Source: tan((nu - E)/2) = b sin E/(1 - b cos E) with b = e/(1 + sqrt(1 - e^2)); R. Broucke and
/// P. Cefola, Celestial Mechanics 7 (1973) 388.
Extended true_anomaly_of_eccentric_deg(const Extended& eccentric_anomaly_deg,
                                       const Extended& eccentricity);

/// Mean anomaly that belongs to a true anomaly on an ellipse, good to about 33 digits, from 0 to
/// 360 degrees.
///
/// Throws Error(usage) unless 0 <= e < 1 and the anomaly is finite.
Extended mean_anomaly_of_true_deg(const Extended& true_anomaly_deg, const Extended& eccentricity);

/// Semi-major axis of the ellipse with this period, a^3 = mu (T/2 pi)^2.
///
/// Throws Error(usage) unless T > 0, mu > 0 and both are finite.
Extended semi_major_axis_of_period_km(const Extended& period_s, double mu_km3_s2);

/// Period of the osculating Kepler ellipse in seconds, or no value on a parabola, a hyperbola, or a
/// straight line through the centre, which have none.
///
/// Precondition: the position is not the origin, mu > 0.
///
/// Source: the vis-viva integral 1/a = 2/r - v^2/mu and Kepler's third law; R. H. Battin, An
/// Introduction to the Mathematics and Methods of Astrodynamics, revised ed. (1999), chapter 3.
std::optional<Extended> osculating_period_s(const CartesianState& state, double mu_km3_s2);

}  // namespace hamjet
