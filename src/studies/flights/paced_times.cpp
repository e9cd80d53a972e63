#include "paced_times.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../integrators/momentum_unit.hpp"
#include "../nominal/nominal_period.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"

namespace hamjet {

int interval_count(const Scene& scene, double time, const IntervalCount& wanted) {
  const double circle = is_orbit(scene.system.model)
                            ? 2 * std::numbers::pi * std::pow(initial_distance(scene.nominal), 1.5)
                            : std::abs(time);
  const double revolution = nominal_period(scene).value_or(circle);
  return static_cast<int>(
      std::clamp(std::ceil(wanted.each_revolution * std::abs(time) / revolution),
                 static_cast<double>(wanted.fewest), static_cast<double>(wanted.most)));
}

std::vector<double> paced_times(const Scene& scene, double time, int count) {
  const std::vector<double>& z = scene.nominal;
  const double inverse_axis =
      2 / std::hypot(z[0], z[1], z[2]) - (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]);
  const auto equal = [&](int k) { return time * k / count; };
  std::vector<double> times = {0};
  if (!is_orbit(scene.system.model) || !(inverse_axis > 0)) {
    for (int k = 1; k <= count; ++k) times.push_back(equal(k));
    return times;
  }
  // e cos E = 1 - r/a and e sin E = r.v / sqrt(mu a), in units with mu = 1.
  const double e_cosine = 1 - std::hypot(z[0], z[1], z[2]) * inverse_axis;
  const double e_sine = (z[0] * z[3] + z[1] * z[4] + z[2] * z[5]) * std::sqrt(inverse_axis);
  const double e = std::min(std::hypot(e_cosine, e_sine), 1 - 1e-12);
  const double first = std::atan2(e_sine, e_cosine);
  const double motion = std::pow(inverse_axis, 1.5);
  constexpr double degrees = 180 / std::numbers::pi;
  const double mean = (first - e * std::sin(first) + motion * time) * degrees;
  const double last = static_cast<double>(eccentric_anomaly_of_mean_deg(mean, e)) / degrees;
  for (int k = 1; k < count; ++k) {
    const double step = (last - first) * k / count;
    // E - e sin E minus its value at the start, without subtracting nearly equal numbers.
    const double sines = 2 * std::cos(first + step / 2) * std::sin(step / 2);
    times.push_back((step - e * sines) / motion);
  }
  times.push_back(time);
  return times;
}

}  // namespace hamjet
