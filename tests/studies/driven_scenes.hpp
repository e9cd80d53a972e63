#pragma once

#include <memory>
#include <vector>

#include "formation_scenes.hpp"
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

/// A deputy a few thousandths of the distance from the chief.
inline std::vector<double> driven_deputy() {
  std::vector<double> state = driven_chief(1).nominal;
  const std::vector<double> deviation = {2e-3, -1e-3, 3e-3, 1e-3, 2e-3, -1e-3};
  for (std::size_t i = 0; i < 6; ++i) state[i] += deviation[i];
  return state;
}

}  // namespace hamjet
