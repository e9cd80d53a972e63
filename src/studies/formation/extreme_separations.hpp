#pragma once

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The distance of a deputy from its chief. It is computed here alone, so that all who show it have
/// the same digits.
double separation_m(const RelativeState& state);

/// Where a deputy is at a time of its own.
struct SeparationAt {
  double time = 0;  ///< canonical
  RelativeState state;
};

/// When a deputy is nearest to its chief and when farthest.
struct ExtremeSeparations {
  SeparationAt nearest;
  SeparationAt farthest;
};

/// The extremes of a deputy that starts with this deviation from the scene's chief (canonical) and
/// flies for a time without impulses; states in `frame`. No look between the steps of the flight is
/// left out, see ExtremeDistance. Throws as fly_arcs.
ExtremeSeparations extreme_separations(const Scene& scene, const std::vector<double>& deviation,
                                       RelativeFrame frame, double time);

}  // namespace hamjet
