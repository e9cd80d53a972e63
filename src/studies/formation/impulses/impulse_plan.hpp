#pragma once

#include <optional>

#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The primer vector of a transfer with two impulses, on the linear flow; absent where the flow's
/// positions cannot be commanded, or an impulse is zero.
std::optional<PrimerHistory> primer_history(const Scene& scene, const ComputedProblem& problem,
                                            const LinearFlow& flow, const TransferPoint& point);

/// The least impulses for some of the scene's transfer times on the linear flow, and the plan for
/// the best of them, corrected by flying until it misses by the scene's `refined_miss_m`.
OptimalImpulses optimal_impulses(const Scene& scene, const ComputedProblem& problem,
                                 const LinearFlow& flow, const ProgressCallback& progress);

}  // namespace hamjet
