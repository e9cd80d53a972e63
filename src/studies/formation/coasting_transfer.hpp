#pragma once

#include "companion_flow.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The linear flow over the longest wait plus the last transfer time. Throws as LinearFlow.
CompanionFlow coasting_flow(const Scene& scene, const ComputedProblem& problem);

/// The cheapest transfer with two impulses, the first of which waits for up to the scene's
/// `longest_coast` while the deputy drifts. The listed transfer times are the times between the
/// impulses. For some of them the start is found on the linear flow, from a grid of 24 per
/// revolution and Brent's method; the cheapest candidates are then flown. The flow is that of
/// coasting_flow.
CoastingTransfer coasting_transfer(const Scene& scene, const ComputedProblem& problem,
                                   const CompanionFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
