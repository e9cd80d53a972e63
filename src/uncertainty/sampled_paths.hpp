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

/// The number of samples in the block that begins with sample `first`, of `count` samples in all.
inline std::size_t in_block(std::size_t count, std::size_t first) {
  return first < count ? std::min(samples_in_block, count - first) : 0;
}

/// The deviation of one sample of a block; the block is a structure of arrays.
EncounterDeviation deviation_of(std::span<const double> points, std::size_t sample);

/// A relative path: position and velocity at each node.
using SampledPath = std::vector<std::array<double, 6>>;

/// Extracts the path of one sample of `count` from the output of RelativePaths::evaluate.
void take_path(std::span<const double> states, std::size_t count, std::size_t sample,
               SampledPath& path);

/// The least distance along a path, also between the nodes.
double least_distance(const RelativePaths& paths, const SampledPath& path);

}  // namespace hamjet
