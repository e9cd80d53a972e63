#pragma once

#include <optional>

#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The primer vector of a transfer with two impulses, on the linear flow; absent where the flow's
/// positions cannot be commanded, or an impulse is zero.
std::optional<PrimerHistory> primer_history(const Scene& scene, const ComputedProblem& problem,
                                            const LinearFlow& flow, const TransferPoint& point);

/// The least impulses for some of the scene's transfer times in the linear theory about the chief,
/// and the plan for the best of them, flown. Where that theory is seen not to hold, its impulses
/// for the other times are flown too, and the plan begins from the least of these and of the ways
/// that `others` found, so that it costs no more than any.
OptimalImpulses optimal_impulses(const Scene& scene, const ComputedProblem& problem,
                                 const LinearFlow& flow, const TransferResult& others,
                                 const ProgressCallback& progress);

}  // namespace hamjet
