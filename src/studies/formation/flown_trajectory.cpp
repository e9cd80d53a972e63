#include "flown_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../integrators/momentum_unit.hpp"
#include "../exact_flow.hpp"
#include "single_transfer.hpp"

namespace hamjet {

RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, double time, int count) {
  const SharedSystem system = make_system(scene);
  const MetricUnits units = metric_units(scene);
  std::vector<double> chief = scene.nominal;
  std::vector<double> deputy = chief;
  for (std::size_t i = 0; i < deputy.size(); ++i) deputy[i] += deviation[i];
  RelativeTrajectory trajectory;
  trajectory.frame = frame;
  for (int k = 0; k <= count; ++k) {
    if (k > 0) {
      chief = exact_flow(system, chief, time / count);
      deputy = exact_flow(system, deputy, time / count);
    }
    std::vector<double> difference;
    for (std::size_t i = 0; i < deputy.size(); ++i) difference.push_back(deputy[i] - chief[i]);
    trajectory.times.push_back(time * k / count);
    trajectory.chief.push_back(chief);
    trajectory.deputy.push_back(deputy);
    trajectory.states.push_back(ChiefFrame(chief, units, frame).relative(difference));
  }
  return trajectory;
}

int smooth_intervals(const Scene& scene) {
  constexpr double each_revolution = 48;
  constexpr double fewest = 64;
  constexpr double most = 1024;
  const double revolution = 2 * std::numbers::pi * std::pow(initial_distance(scene.nominal), 1.5);
  return static_cast<int>(
      std::clamp(std::ceil(each_revolution * std::abs(scene.duration) / revolution), fewest, most));
}

}  // namespace hamjet
