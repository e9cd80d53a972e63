#include "collision_judgement.hpp"

#include <algorithm>
#include <vector>

#include "cubic_arc.hpp"

namespace hamjet {

void take_linear_path(const RelativePaths& paths, const EncounterDeviation& deviation,
                      SampledPath& path) {
  for (std::size_t node = 0; node < path.size(); ++node) {
    const LinearRelativeState& linear = paths.linear(node);
    const Eigen::Matrix<double, 6, 1> state = linear.mean + linear.by_deviation * deviation;
    for (std::size_t c = 0; c < 6; ++c) path[node][c] = state[static_cast<Eigen::Index>(c)];
  }
}

std::optional<double> first_event(const RelativePaths& paths, const SampledPath& path,
                                  double radius, CollisionEvent event) {
  const double square = radius * radius;
  const std::vector<double>& times = paths.times();
  std::vector<double> parts;
  for (const std::size_t node : paths.arcs()) {
    const double length = times[node + 1] - times[node];
    const SquaredDistance arc(path[node], path[node + 1], length);
    if (arc.lower_bound() >= square) continue;
    const bool begins_inside = node == 0 && paths.has_begin() && arc.first() < square;
    if (begins_inside && event == CollisionEvent::nearer) return times[0];
    parts.clear();
    arc.entries(square, parts);
    if (!parts.empty()) return times[node] + length * *std::min_element(parts.begin(), parts.end());
  }
  return {};
}

Judgement judge_path(const RelativePaths& paths, const SampledPath& path, double radius,
                     double error, CollisionEvent event) {
  const auto has_event = [&](double r) {
    return r > 0 && first_event(paths, path, r, event).has_value();
  };
  Judgement result;
  const bool of_larger = has_event(radius + error);
  // A path that is nearer than the smaller radius is also nearer than the larger one. For entries
  // this does not follow: a path may begin inside the larger sphere alone.
  if (!of_larger && event == CollisionEvent::nearer) return result;
  result.first = first_event(paths, path, radius, event);
  const bool of_smaller = has_event(radius - error);
  result.is_sure = of_larger && result.first && of_smaller;
  result.is_possible = of_larger || result.first || of_smaller;
  return result;
}

}  // namespace hamjet
