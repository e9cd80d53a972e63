#include "collision_arrays.hpp"

#include <limits>

namespace hamjet::io {

std::vector<NumberArray> collision_arrays(const CollisionResult& result) {
  const CollisionProbability& p = result.probability;
  std::vector<NumberArray> arrays;
  const auto add = [&](const char* name, double value) { arrays.push_back({name, {}, {value}}); };
  const auto add_list = [&](const char* name, const std::vector<double>& values) {
    arrays.push_back({name, {values.size()}, values});
  };
  add("probability", p.probability);
  add_list("interval", {p.lower, p.upper});
  add("path_error_m", p.path_error);
  add("standard_error", p.standard_error);
  add("samples", static_cast<double>(p.samples));
  add("hits", static_cast<double>(p.hits));
  add("equivalent_samples", p.equivalent_samples);
  add("change_from_lower_order", p.change_from_lower_order);
  add_list("times_s", p.times);
  add_list("by_time", p.by_time);
  const LeastSeparations& least = result.separations;
  add_list("separation_shares", least.shares);
  add_list("separations_m", least.separations);
  std::vector<double> intervals;
  for (std::size_t k = 0; k < least.shares.size(); ++k) {
    intervals.push_back(least.lower[k]);
    intervals.push_back(least.upper[k]);
  }
  arrays.push_back({"separation_intervals_m", {least.shares.size(), 2}, intervals});
  const CollisionProbability& whole = probability_of_passage(result);
  add("whole_passage_probability", whole.probability);
  add_list("whole_passage_interval", {whole.lower, whole.upper});
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const UncertainApproach* const nearest = nearest_approach(result);
  add("approach_time_s", nearest ? nearest->time_s : none);
  add("approach_distance_m", nearest ? nearest->distance_m : none);
  add("approach_speed_m_s", nearest ? nearest->speed_m_s : none);
  const ShortEncounter* const plane = nearest && nearest->plane ? &*nearest->plane : nullptr;
  add("foster", plane ? plane->foster : none);
  add("alfano", plane ? plane->alfano : none);
  add("chan", plane ? plane->chan : none);
  add("short_encounter_departure", plane ? plane->departure : none);
  return arrays;
}

}  // namespace hamjet::io
