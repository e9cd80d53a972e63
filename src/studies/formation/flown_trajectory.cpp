#include "flown_trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "../../algebra/state_sums.hpp"
#include "../exact_flow.hpp"
#include "single_transfer.hpp"

namespace hamjet {

RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, const std::vector<double>& times,
                                    std::size_t parts) {
  const SharedSystem system = make_system(scene);
  const MetricUnits units = metric_units(scene);
  RelativeTrajectory trajectory;
  trajectory.frame = frame;
  const auto add = [&](double at, const std::vector<double>& chief,
                       const std::vector<double>& deputy) {
    trajectory.times.push_back(at);
    trajectory.chief.push_back(chief);
    trajectory.deputy.push_back(deputy);
    trajectory.states.push_back(
        ChiefFrame(chief, units, frame).relative(state_difference(deputy, chief)));
  };
  std::vector<double> chief = scene.nominal;
  std::vector<double> deputy = state_sum(chief, deviation);
  add(0, chief, deputy);
  for (std::size_t last = parts; last < times.size(); last += parts) {
    std::vector<double> chief_between = chief;
    std::vector<double> deputy_between = deputy;
    for (std::size_t k = last - parts + 1; k < last; ++k) {
      const ClockTime from = scene.start_time + times[k - 1];
      chief_between = exact_flow(system, chief_between, from, times[k] - times[k - 1]);
      deputy_between = exact_flow(system, deputy_between, from, times[k] - times[k - 1]);
      add(times[k], chief_between, deputy_between);
    }
    const ClockTime from = scene.start_time + times[last - parts];
    chief = exact_flow(system, chief, from, times[last] - times[last - parts]);
    deputy = exact_flow(system, deputy, from, times[last] - times[last - parts]);
    add(times[last], chief, deputy);
  }
  return trajectory;
}

}  // namespace hamjet
