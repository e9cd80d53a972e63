#pragma once

#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The chief of a scene and a deputy that starts with this deviation (canonical), both flown with
/// the full equations of motion to each of the times (canonical, the first 0, moving away from it);
/// relative states in `frame`. Of the times between every `parts`-th one none is flown on from:
/// each start anew rounds, and what is far ahead keeps that.
RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, const std::vector<double>& times,
                                    std::size_t parts = 1);

}  // namespace hamjet
