#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "cubic_arc.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// Samples of relative paths that are evaluated side by side.
inline constexpr std::size_t samples_in_block = 64;

/// How many samples of so many are in the block that begins with one of them.
inline std::size_t in_block(std::size_t count, std::size_t first) {
  return first < count ? std::min(samples_in_block, count - first) : 0;
}

/// The states of one sample at all nodes.
inline void take_path(std::span<const double> states, std::size_t count, std::size_t sample,
                      std::vector<std::array<double, 6>>& path) {
  for (std::size_t node = 0; node < path.size(); ++node) {
    for (std::size_t c = 0; c < 6; ++c) path[node][c] = states[(6 * node + c) * count + sample];
  }
}

/// How near a path of states at all nodes comes to the other spacecraft, between the nodes too.
inline double least_distance(const RelativePaths& paths,
                             const std::vector<std::array<double, 6>>& path) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<double>& times = paths.times();
  for (const std::size_t node : paths.arcs()) {
    least = SquaredDistance(path[node], path[node + 1], times[node + 1] - times[node]).least(least);
  }
  return std::sqrt(least);
}

}  // namespace hamjet
