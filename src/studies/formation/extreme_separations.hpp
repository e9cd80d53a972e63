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

/// The extremes of a flown trajectory, between its times too: where the separation turns between
/// two of them, the turn is found by flying on from the first. Of many turns those are tried that
/// cubic interpolation of the squared separation has as the most extreme. Throws as exact_flow.
ExtremeSeparations extreme_separations(const Scene& scene, const RelativeTrajectory& flown);

/// The least of |(R/a, T/b, N/c)| along a flown trajectory, between its times too, likewise. The
/// trajectory is in rotating RTN, and the semi-axes a, b, c in metres. Throws as exact_flow.
double least_ratio(const Scene& scene, const RelativeTrajectory& flown,
                   const Eigen::Vector3d& semi_axes_m);

}  // namespace hamjet
