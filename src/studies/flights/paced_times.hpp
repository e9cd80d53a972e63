#pragma once

#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Limits for the number of intervals into which a time is divided.
struct IntervalCount {
  int each_revolution;
  int fewest;
  int most;
};
int interval_count(const Scene& scene, double time, const IntervalCount& wanted);

/// Intervals of a path that is drawn: with fewer it would have corners; more, over 256 revolutions,
/// would make a file slow to show.
inline constexpr IntervalCount drawn_path = {64, 400, 16384};

/// The canonical times from 0 to a time in this number of steps. The steps are equal in the
/// eccentric anomaly of the scene's chief, on its ellipse at the start, so that perigee has as many
/// of them as apogee; they are equal in time if the chief has no ellipse.
std::vector<double> paced_times(const Scene& scene, double time, int count);

}  // namespace hamjet
