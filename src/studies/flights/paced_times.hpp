#pragma once

#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// How many intervals a time is divided into.
struct IntervalCount {
  int each_revolution;
  int fewest;
  int most;
};
int interval_count(const Scene& scene, double time, const IntervalCount& wanted);

/// Of a path that is drawn: with fewer it has corners, and more, of over 256 revolutions, make a
/// file slow to show.
inline constexpr IntervalCount drawn_path = {64, 400, 16384};

/// The canonical times from 0 to a time in so many steps that are equal in the eccentric anomaly of
/// the scene's chief, on its ellipse at the start, so that perigee has as many of them as apogee;
/// equal in time where it has no ellipse.
std::vector<double> paced_times(const Scene& scene, double time, int count);

}  // namespace hamjet
