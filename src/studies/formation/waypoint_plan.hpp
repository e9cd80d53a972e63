#pragma once

#include "companion_flow.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Transfers through the scene's waypoints to its end, at each of its transfer times after the last
/// waypoint. The answer of the linear flow for each leg is corrected by Newton's method on flown
/// trajectories, until the miss is at most the scene's `refined_miss_m`.
WaypointTransfers waypoint_transfers(const Scene& scene, const ComputedProblem& problem,
                                     const CompanionFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
