#include "flown_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../integrators/momentum_unit.hpp"
#include "../exact_flow.hpp"
#include "single_transfer.hpp"

namespace hamjet {

RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, double time, int count, int parts) {
  const SharedSystem system = make_system(scene);
  const MetricUnits units = metric_units(scene);
  RelativeTrajectory trajectory;
  trajectory.frame = frame;
  const auto add = [&](double at, const std::vector<double>& chief,
                       const std::vector<double>& deputy) {
    std::vector<double> difference;
    for (std::size_t i = 0; i < deputy.size(); ++i) difference.push_back(deputy[i] - chief[i]);
    trajectory.times.push_back(at);
    trajectory.chief.push_back(chief);
    trajectory.deputy.push_back(deputy);
    trajectory.states.push_back(ChiefFrame(chief, units, frame).relative(difference));
  };
  std::vector<double> chief = scene.nominal;
  std::vector<double> deputy = chief;
  for (std::size_t i = 0; i < deputy.size(); ++i) deputy[i] += deviation[i];
  add(0, chief, deputy);
  const double interval = time / count;
  for (int k = 1; k <= count; ++k) {
    std::vector<double> chief_between = chief;
    std::vector<double> deputy_between = deputy;
    for (int part = 1; part < parts; ++part) {
      chief_between = exact_flow(system, chief_between, interval / parts);
      deputy_between = exact_flow(system, deputy_between, interval / parts);
      add(time * (k - 1) / count + interval * part / parts, chief_between, deputy_between);
    }
    chief = exact_flow(system, chief, interval);
    deputy = exact_flow(system, deputy, interval);
    add(time * k / count, chief, deputy);
  }
  return trajectory;
}

int interval_count(const Scene& scene, double time, const IntervalCount& wanted) {
  const double revolution = 2 * std::numbers::pi * std::pow(initial_distance(scene.nominal), 1.5);
  return static_cast<int>(
      std::clamp(std::ceil(wanted.each_revolution * std::abs(time) / revolution),
                 static_cast<double>(wanted.fewest), static_cast<double>(wanted.most)));
}

}  // namespace hamjet
