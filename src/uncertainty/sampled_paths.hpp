#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "relative_paths.hpp"

namespace hamjet {

/// Samples of relative paths that are evaluated side by side.
inline constexpr std::size_t samples_in_block = 64;

/// How many samples of so many are in the block that begins with one of them.
inline std::size_t in_block(std::size_t count, std::size_t first) {
  return first < count ? std::min(samples_in_block, count - first) : 0;
}

/// The deviation of one sample of a block, a structure of arrays.
EncounterDeviation deviation_of(std::span<const double> points, std::size_t sample);

/// A relative path: position and velocity at each node.
using SampledPath = std::vector<std::array<double, 6>>;

/// The path of one sample of `count`, from what RelativePaths::evaluate gives.
void take_path(std::span<const double> states, std::size_t count, std::size_t sample,
               SampledPath& path);

/// The least distance of a path, between the nodes too.
double least_distance(const RelativePaths& paths, const SampledPath& path);

}  // namespace hamjet
