#pragma once

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The linear flow over the longest wait and the last transfer time. Throws as LinearFlow.
LinearFlow coasting_flow(const Scene& scene, const ComputedProblem& problem);

/// The least transfer of two impulses whose first one waits for up to the scene's `longest_coast`
/// while the deputy drifts: for some of the listed transfer times, which are between the impulses,
/// the start is found on the linear flow, from a grid of 24 a revolution and Brent's method; the
/// lowest are then flown. The flow is coasting_flow's.
CoastingTransfer coasting_transfer(const Scene& scene, const ComputedProblem& problem,
                                   const LinearFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
