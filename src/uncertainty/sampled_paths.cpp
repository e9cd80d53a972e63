#include "sampled_paths.hpp"

#include <cmath>
#include <limits>

#include "cubic_arc.hpp"

namespace hamjet {

EncounterDeviation deviation_of(std::span<const double> points, std::size_t sample) {
  EncounterDeviation xi;
  for (std::size_t i = 0; i < encounter_variables; ++i) {
    xi[static_cast<Eigen::Index>(i)] = points[i * samples_in_block + sample];
  }
  return xi;
}

void take_path(std::span<const double> states, std::size_t count, std::size_t sample,
               SampledPath& path) {
  for (std::size_t node = 0; node < path.size(); ++node) {
    for (std::size_t c = 0; c < 6; ++c) path[node][c] = states[(6 * node + c) * count + sample];
  }
}

double least_distance(const RelativePaths& paths, const SampledPath& path) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<double>& times = paths.times();
  for (const std::size_t node : paths.arcs()) {
    least = SquaredDistance(path[node], path[node + 1], times[node + 1] - times[node]).least(least);
  }
  return std::sqrt(least);
}

}  // namespace hamjet
