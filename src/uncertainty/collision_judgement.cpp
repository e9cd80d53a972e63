#include "collision_judgement.hpp"

#include <algorithm>
#include <cmath>
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

namespace {

/// An arc of a path, by its first node, that comes near a sphere.
struct NearArc {
  std::size_t node;
  SquaredDistance distance;
};

/// The arcs of a path that may come nearer than a radius.
std::vector<NearArc> near_arcs(const RelativePaths& paths, const SampledPath& path, double radius) {
  const std::vector<double>& times = paths.times();
  std::vector<NearArc> near;
  for (const std::size_t node : paths.arcs()) {
    const SquaredDistance distance(path[node], path[node + 1], times[node + 1] - times[node]);
    if (distance.lower_bound() < radius * radius) near.push_back({node, distance});
  }
  return near;
}

/// Whether the path is inside the sphere at the beginning of the window, and this counts.
bool counts_at_begin(const RelativePaths& paths, const NearArc& arc, double radius,
                     CollisionEvent event) {
  return event == CollisionEvent::nearer && arc.node == 0 && paths.has_begin() &&
         arc.distance.first() < radius * radius;
}

bool has_event(const RelativePaths& paths, const std::vector<NearArc>& arcs, double radius,
               CollisionEvent event) {
  return radius > 0 && std::any_of(arcs.begin(), arcs.end(), [&](const NearArc& arc) {
           return counts_at_begin(paths, arc, radius, event) ||
                  arc.distance.enters(radius * radius);
         });
}

/// The time of the first event of arcs that are in order.
std::optional<double> first_event(const RelativePaths& paths, const std::vector<NearArc>& arcs,
                                  double radius, CollisionEvent event) {
  const std::vector<double>& times = paths.times();
  std::vector<double> parts;
  for (const auto& [node, distance] : arcs) {
    if (counts_at_begin(paths, {node, distance}, radius, event)) return times[0];
    distance.entries(radius * radius, parts);
    if (parts.empty()) continue;
    const double length = times[node + 1] - times[node];
    return times[node] + length * *std::min_element(parts.begin(), parts.end());
  }
  return {};
}

}  // namespace

bool has_event(const RelativePaths& paths, const SampledPath& path, double radius,
               CollisionEvent event) {
  return has_event(paths, near_arcs(paths, path, radius), radius, event);
}

Judgement judge_path(const RelativePaths& paths, const SampledPath& path, double radius,
                     double error, CollisionEvent event) {
  const std::vector<NearArc> arcs = near_arcs(paths, path, radius + std::abs(error));
  Judgement result;
  const bool of_larger = has_event(paths, arcs, radius + error, event);
  // A path that is nearer than the smaller radius is also nearer than the larger one. For entries
  // this does not follow: a path may begin inside the larger sphere alone.
  if (!of_larger && event == CollisionEvent::nearer) return result;
  result.first = first_event(paths, arcs, radius, event);
  const bool of_smaller = has_event(paths, arcs, radius - error, event);
  result.is_sure = of_larger && result.first && of_smaller;
  result.is_possible = of_larger || result.first || of_smaller;
  return result;
}

}  // namespace hamjet
