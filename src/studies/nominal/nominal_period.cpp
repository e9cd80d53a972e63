#include "nominal_period.hpp"

#include <cmath>
#include <numbers>

#include "../descriptions/system_description.hpp"

namespace hamjet {

std::optional<double> nominal_period(const Scene& scene) {
  const auto period_s = description_of(scene.system.model).period_s;
  if (period_s != nullptr) return period_s(scene.system);
  if (!is_orbit(scene.system.model)) return std::nullopt;
  const std::vector<double>& z = scene.nominal;
  // The vis-viva equation with mu = 1.
  const double inverse_axis =
      2 / std::hypot(z[0], z[1], z[2]) - (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]);
  if (!(inverse_axis > 0)) return std::nullopt;
  return 2 * std::numbers::pi * std::pow(inverse_axis, -1.5);
}

}  // namespace hamjet
