#pragma once

#include <algorithm>
#include <vector>

#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// Half of how far relative places reach along each axis, metres.
inline Eigen::Vector3d half_widths_m(const std::vector<RelativeState>& states) {
  if (states.empty()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d least = states.front().position_m;
  Eigen::Vector3d most = least;
  for (const RelativeState& state : states) {
    least = least.cwiseMin(state.position_m);
    most = most.cwiseMax(state.position_m);
  }
  return (most - least) / 2;
}

/// The largest distance from the chief, metres.
inline double largest_distance_m(const std::vector<RelativeState>& states) {
  double size = 0;
  for (const RelativeState& state : states) size = std::max(size, state.position_m.norm());
  return size;
}

}  // namespace hamjet
