#include "nearest_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "../../algebra/state_sums.hpp"
#include "../flights/extreme_distance.hpp"
#include "companion_flow.hpp"
#include "single_transfer.hpp"

namespace hamjet {

std::vector<DeputyPair> nearest_of_pairs(const Scene& scene,
                                         const std::vector<AssignedTransfer>& transfers) {
  const MetricUnits units = metric_units(scene);
  const auto frame = [&](const std::vector<double>& chief) {
    return ChiefFrame(chief, units, scene.transfer->frame);
  };
  const FlownTogether both(scene);
  std::vector<const AssignedTransfer*> flown;
  // The deputies after their first impulses, then the chief, which defines the frame at their
  // arrivals.
  std::vector<std::vector<double>> states;
  std::vector<double> arrivals;
  for (const AssignedTransfer& assigned : transfers) {
    if (!assigned.transfer.has_answer()) continue;
    flown.push_back(&assigned);
    RelativeState start = scene.assignment->deputies[assigned.deputy];
    start.velocity_m_s += assigned.transfer.best().start_change_m_s;
    states.push_back(
        both.of_deputy(state_sum(scene.nominal, frame(scene.nominal).deviation(start))));
    arrivals.push_back(assigned.transfer.time);
  }
  if (flown.size() < 2) return {};
  states.push_back(both.of_chief(scene.nominal));
  std::sort(arrivals.begin(), arrivals.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  arrivals.erase(std::unique(arrivals.begin(), arrivals.end()), arrivals.end());
  std::vector<DeputyPair> pairs;
  std::vector<ExtremeDistance> least;
  for (std::size_t i = 0; i < flown.size(); ++i) {
    for (std::size_t j = i + 1; j < flown.size(); ++j) {
      pairs.push_back({flown[i]->deputy, flown[j]->deputy, 0, 0});
      least.emplace_back(ExtremeDistance::Kind::least);
    }
  }
  const auto look = [&](const FlightArc& arc) {
    std::size_t pair = 0;
    for (std::size_t i = 0; i < flown.size(); ++i) {
      for (std::size_t j = i + 1; j < flown.size(); ++j, ++pair) {
        least[pair].add(arc, separation_along(arc, i, j));
      }
    }
  };
  double now = 0;
  for (const double arrival : arrivals) {
    states = fly_arcs(both.system(), std::move(states), scene.start_time + now, arrival - now, look,
                      now);
    now = arrival;
    for (std::size_t i = 0; i < flown.size(); ++i) {
      if (flown[i]->transfer.time != arrival) continue;
      const RelativeState change = {Eigen::Vector3d::Zero(),
                                    flown[i]->transfer.best().end_change_m_s};
      const std::vector<double> impulse = frame(states.back()).deviation(change);
      for (std::size_t k = 0; k < impulse.size(); ++k) states[i][k] += impulse[k];
    }
  }
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    pairs[pair].time = least[pair].time();
    pairs[pair].separation_m = least[pair].distance() * units.length_m;
  }
  return pairs;
}

}  // namespace hamjet
