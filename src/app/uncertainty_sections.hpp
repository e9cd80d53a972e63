#pragma once

#include <vector>

#include "../report/uncertainty/uncertainty_report.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::cli {

/// What the report of a scene's uncertainties has besides its moments: the studies of collisions
/// and of passive safety, which this does, where the scene asks for them. Throws as study_collision
/// and study_safety.
std::vector<io::UncertaintySection> uncertainty_sections(const Scene& scene,
                                                         const ProgressCallback& progress);

}  // namespace hamjet::cli
