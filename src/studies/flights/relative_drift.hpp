#pragma once

#include <vector>

#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The drift of a deputy with this deviation (canonical) from a chief; the velocity that leaves
/// none is sought if `finds_holding`. None where one of both is on no ellipse, or a revolution
/// cannot be flown.
std::optional<RelativeDrift> relative_drift(const Scene& scene, const std::vector<double>& chief,
                                            const std::vector<double>& deviation,
                                            RelativeFrame frame, bool finds_holding = true);

/// That of the scene's deputy at its start.
std::optional<RelativeDrift> deputy_drift(const Scene& scene);

}  // namespace hamjet
