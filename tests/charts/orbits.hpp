#pragma once

#include <random>
#include <vector>

#include "charts/chief_orbit.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet::test {

using hamjet::ChiefOrbit;
using hamjet::orbit_of;

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

/// The Gauss method of eight stages with a tolerance.
inline GaussSettings gauss_of(double tolerance) {
  GaussSettings gauss;
  gauss.tolerance = tolerance;
  return gauss;
}

}  // namespace hamjet::test
