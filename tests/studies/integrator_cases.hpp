#pragma once

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "dynamics/double_well.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "support/flow.hpp"

// The four systems of the paper on which every integrator is tested.

namespace hamjet::test {

struct IntegratorCase {
  std::string name;
  DynamicalSystem system;
  std::vector<double> start;
  double period;  ///< the period of the motion, or of its linear part
};

inline void PrintTo(const IntegratorCase& one, std::ostream* out) { *out << one.name; }

inline std::vector<IntegratorCase> integrator_cases() {
  const ReferenceOrbit& orbit = paper_orbit();
  const double speed = std::sqrt(1.3);
  return {{"Oscillator", harmonic_oscillator(), {0.3, -0.8}, 2 * std::numbers::pi},
          {"DoubleWell", double_well(), {1, 0.05}, 6},
          {"Kepler", kepler(), {1, 0, 0, 0, 0.6 * speed, 0.8 * speed}, 10.7},
          {"EarthOrbit", zonal_gravity(orbit.field), orbit.start, 10.7}};
}

}  // namespace hamjet::test
