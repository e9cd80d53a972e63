#pragma once

#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The chief of a scene and a deputy that starts with this deviation (canonical), both flown with
/// the full equations of motion over a time, at so many equal intervals; relative states in
/// `frame`. Each interval may have further states at equal `parts` of it, off which none after it
/// is flown: each start anew rounds, and what is far ahead keeps that.
RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, double time, int count, int parts = 1);

/// How many intervals a time is divided into.
struct IntervalCount {
  int each_revolution;  ///< of a circle through the chief
  int fewest;
  int most;
};
int interval_count(const Scene& scene, double time, const IntervalCount& wanted);

/// Of a path that is drawn: with fewer it has corners, and more, of over 256 revolutions, make a
/// file slow to show.
inline constexpr IntervalCount drawn_path = {64, 400, 16384};

}  // namespace hamjet
