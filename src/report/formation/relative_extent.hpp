#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "../../text/quantity_text.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::io {

/// How far relative places reach along each axis, metres.
struct RelativeExtent {
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;

  void include(const Eigen::Vector3d& position_m) {
    least = least.cwiseMin(position_m);
    most = most.cwiseMax(position_m);
  }
  void include(const std::vector<RelativeState>& states) {
    for (const RelativeState& state : states) include(state.position_m);
  }
  double largest_m() const { return std::max(most.maxCoeff(), -least.minCoeff()); }
  /// The width of a square that holds the places in every projection.
  double span_m() const { return std::max((most - least).maxCoeff(), 1e-6); }
  /// Whether the place is within so many spans of the middle, along every axis.
  bool is_near(const Eigen::Vector3d& position_m, double spans) const {
    return (position_m - (least + most) / 2).cwiseAbs().maxCoeff() <= spans * span_m();
  }
};

/// Beside a chief that is more spans than this away, what is drawn would be a dot.
inline constexpr double most_spans_to_chief = 5;

/// What a legend says in place of a chief that is left out of the drawing.
inline std::string far_chief_text(const RelativeExtent& extent) {
  return "the chief, " + length_text(((extent.least + extent.most) / 2).norm()) +
         " away, is not shown";
}

}  // namespace hamjet::io
