#include "nominal_period.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamjet {

std::optional<double> nominal_period(const Scene& scene) {
  if (scene.system.model == SystemModel::harmonic_oscillator) {
    return 2 * std::numbers::pi * std::sqrt(scene.system.mass_kg / scene.system.stiffness_N_per_m);
  }
  if (scene.system.model == SystemModel::oscillator_pair) {
    const double softer =
        std::min(scene.system.stiffness_N_per_m, scene.system.second_stiffness_N_per_m);
    return 2 * std::numbers::pi * std::sqrt(scene.system.mass_kg / softer);
  }
  if (!is_orbit(scene.system.model)) return std::nullopt;
  const std::vector<double>& z = scene.nominal;
  // The vis-viva equation with mu = 1.
  const double inverse_axis =
      2 / std::hypot(z[0], z[1], z[2]) - (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]);
  if (!(inverse_axis > 0)) return std::nullopt;
  return 2 * std::numbers::pi * std::pow(inverse_axis, -1.5);
}

}  // namespace hamjet
