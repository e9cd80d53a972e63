#pragma once

#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The chief of a scene and a deputy that starts with this deviation (canonical), both flown with
/// the full equations of motion over a time, at so many equal intervals; relative states in
/// `frame`.
RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, double time, int count);

/// Intervals of the scene's duration that make a smooth curve: so many a revolution of a circle
/// through the chief, within limits.
int smooth_intervals(const Scene& scene);

}  // namespace hamjet
