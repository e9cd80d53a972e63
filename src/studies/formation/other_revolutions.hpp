#pragma once

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Transfers whose deputy makes so many whole revolutions more or fewer than its chief as the
/// scene's `revolutions` say: from the ellipses of Lambert's problem by Newton's method on flown
/// trajectories, for each of the scene's transfer times. The chief's own number is that for which
/// the deputy's angle is nearest to the chief's; of the ellipses that make it, the one whose
/// velocity is nearest to the deputy's own is the transfer that polynomials answer, and is left
/// out.
OtherRevolutions other_revolutions(const Scene& scene, const ComputedProblem& problem,
                                   const LinearFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
