#pragma once

#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The chief of a scene and a deputy that starts with this canonical deviation, both flown with the
/// full equations of motion to each of the times (canonical, the first one 0, moving away from it);
/// relative states are in `frame`. Flights continue only from every `parts`-th time, because each
/// new start adds rounding, which later states keep.
RelativeTrajectory flown_trajectory(const Scene& scene, const std::vector<double>& deviation,
                                    RelativeFrame frame, const std::vector<double>& times,
                                    std::size_t parts = 1);

}  // namespace hamjet
