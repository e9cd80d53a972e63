#pragma once

#include "deputy_motion.hpp"

namespace hamjet {

/// study_deputy_motion of a scene whose chief or deputy has manoeuvres, forward in time. Coasting
/// arcs are studied one after the other, each with polynomials that begin with it; burns are flown
/// between them.
DeputyMotion manoeuvred_motion(const Scene& scene, const ProgressCallback& progress);

}  // namespace hamjet
