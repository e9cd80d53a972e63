#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "../formation_scenes.hpp"
#include "hamjet/studies/propagation.hpp"
#include "support/driven_kepler.hpp"

namespace hamjet {

/// The time of the clock at which the chief of a driven scene stands.
inline constexpr double late = 2.3;

inline const SharedSystem& driven() {
  static const SharedSystem system(test::driven_kepler());
  return system;
}

/// A chief with e = 0.3, from perigee, inclined, under forces that depend on the time.
inline Scene driven_chief(int order) {
  Scene scene = kepler_chief(0.3, 7000, 1000, order);
  scene.nominal = {1, 0, 0, 0, std::sqrt(1.3) * 0.8, std::sqrt(1.3) * 0.6};
  scene.own_system = std::make_shared<const DynamicalSystem>(*driven());
  scene.start_time = ClockTime(late);
  scene.duration = 4;
  return scene;
}

/// The same chief past its apogee, at the time at which it is there: it comes down to its perigee
/// some five units of time later.
inline constexpr double descending_after = 6;
inline Scene descending_chief(int order) {
  Scene scene = driven_chief(order);
  scene.nominal = test::driven_flight(scene.nominal, late, descending_after);
  scene.start_time = ClockTime(late + descending_after);
  return scene;
}

/// A deputy a few thousandths of the distance from the chief.
inline std::vector<double> driven_deputy() {
  std::vector<double> state = driven_chief(1).nominal;
  const std::vector<double> deviation = {2e-3, -1e-3, 3e-3, 1e-3, 2e-3, -1e-3};
  for (std::size_t i = 0; i < 6; ++i) state[i] += deviation[i];
  return state;
}

inline std::vector<double> chief_at(const Scene& scene, double time) {
  return test::driven_flight(scene.nominal, scene.start_time.in<double>(), time);
}

/// Metres that flights and their comparison may leave.
inline constexpr double flown_m = 3e-3;

}  // namespace hamjet
