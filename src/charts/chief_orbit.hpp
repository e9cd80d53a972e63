#pragma once

#include <cmath>
#include <numbers>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet {

/// An orbit about a zonal field, in units in which its initial distance is 1 and mu = 1.
struct ChiefOrbit {
  ZonalGravity field;
  SixNumbers<double> start;
  double period = 0;  ///< period of Kepler's ellipse
};

/// The orbit with these elements (lengths in km, angles in degrees) in the field of the Earth's J2
/// and J3.
inline ChiefOrbit orbit_of(double a, double e, double i, double node, double pericentre,
                           double true_anomaly, double J2 = 1.0826267e-3, double J3 = -2.53e-6) {
  const double mu = 398600.4415;
  const CartesianState state = state_from_elements({a, e, i, node, pericentre, true_anomaly}, mu);
  double r = 0;
  for (const Extended& x : state.position_km) r = std::hypot(r, static_cast<double>(x));
  const double velocity = std::sqrt(mu / r);
  ChiefOrbit orbit;
  for (std::size_t k = 0; k < 3; ++k) {
    orbit.start[k] = static_cast<double>(state.position_km[k]) / r;
    orbit.start[3 + k] = static_cast<double>(state.velocity_km_s[k]) / velocity;
  }
  orbit.field.radius = 6378.1363 / r;
  orbit.field.J[2] = J2;
  orbit.field.J[3] = J3;
  orbit.period = 2 * std::numbers::pi * std::pow(a / r, 1.5);
  return orbit;
}

}  // namespace hamjet
