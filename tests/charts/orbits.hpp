#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet::test {

/// An orbit about a zonal field in units of its start's distance, mu = 1.
struct ChiefOrbit {
  ZonalGravity field;
  SixNumbers<double> start;
  double period = 0;  ///< of Kepler's ellipse
};

/// The orbit of elements (lengths in km, angles in degrees) in the Earth's J2 and J3.
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
  orbit.period = 2 * std::acos(-1.0) * std::pow(a / r, 1.5);
  return orbit;
}

/// Near-circular, eccentric, nearly equatorial, polar and retrograde orbits.
inline std::vector<ChiefOrbit> bound_orbits() {
  return {orbit_of(7086, 0.001, 98.2, 0, 90, 0),   orbit_of(10000, 0.3, 60, 20, 40, 10),
          orbit_of(26600, 0.74, 63.4, 0, 270, 60), orbit_of(42164, 0.0002, 0.05, 10, 20, 30),
          orbit_of(8000, 0.05, 90, 200, 10, 250),  orbit_of(9000, 0.1, 179.5, 0, 20, 130)};
}

/// Six normal numbers times a size.
inline SixNumbers<double> random_deviation(std::mt19937_64& generator, double size) {
  std::normal_distribution<double> normal;
  SixNumbers<double> result;
  for (double& x : result) x = size * normal(generator);
  return result;
}

}  // namespace hamjet::test
