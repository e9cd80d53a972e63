#pragma once

#include <vector>

#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The drift of a deputy with this canonical deviation from a chief, both at `start_time` of the
/// system's clock; the velocity without drift is sought if `finds_holding`. No value if one of both
/// is not on an ellipse, or a revolution cannot be flown.
std::optional<RelativeDrift> relative_drift(const Scene& scene, const std::vector<double>& chief,
                                            const std::vector<double>& deviation,
                                            const ClockTime& start_time, RelativeFrame frame,
                                            bool finds_holding = true);

/// The drift of the scene's deputy at its start.
std::optional<RelativeDrift> deputy_drift(const Scene& scene);

}  // namespace hamjet
