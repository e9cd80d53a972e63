#pragma once

#include "companion_flow.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Transfers in which the deputy makes as many whole revolutions more or fewer than its chief as
/// the scene's `revolutions` say, for each of the scene's transfer times. They are found from the
/// ellipses of Lambert's problem by Newton's method on flown trajectories. A difference of 0 means
/// the number for which the deputy's angle is nearest to the chief's. Of the ellipses with this
/// number, the one whose velocity is nearest to the deputy's own is the transfer that polynomials
/// answer; it is left out.
OtherRevolutions other_revolutions(const Scene& scene, const ComputedProblem& problem,
                                   const CompanionFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
