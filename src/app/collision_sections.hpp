#pragma once

#include <vector>

#include "../report/uncertainty/uncertainty_report.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::cli {

/// What the report of a scene's uncertainties has besides its moments: the study of collisions,
/// which this does, where the scene asks for it. Throws as study_collision.
std::vector<io::UncertaintySection> collision_sections(const Scene& scene,
                                                       const ProgressCallback& progress);

}  // namespace hamjet::cli
