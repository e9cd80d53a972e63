#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "relative_paths.hpp"

namespace hamjet {

/// A relative path: position and velocity at each node.
using SampledPath = std::vector<std::array<double, 6>>;

/// The path of one sample of `count`, from what RelativePaths::evaluate gives.
void take_path(std::span<const double> states, std::size_t count, std::size_t sample,
               SampledPath& path);

/// The least distance of a path, between the nodes too.
double least_distance(const RelativePaths& paths, const SampledPath& path);

}  // namespace hamjet
