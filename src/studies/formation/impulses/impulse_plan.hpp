#pragma once

#include <optional>

#include "../companion_flow.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The primer vector of a transfer with two impulses, on the linear flow; absent if positions
/// cannot be commanded in this flow, or if an impulse is zero.
std::optional<PrimerHistory> primer_history(const Scene& scene, const ComputedProblem& problem,
                                            const CompanionFlow& flow, const TransferPoint& point);

/// The least impulses for some of the scene's transfer times in the linear theory about the chief,
/// and the flown plan for the best of them. If the flights show that this theory does not hold, its
/// impulses for the other times are flown too. The plan then starts from the cheapest of these and
/// of the transfers in `others`, so that it costs no more than any of them.
OptimalImpulses optimal_impulses(const Scene& scene, const ComputedProblem& problem,
                                 const CompanionFlow& flow, const TransferResult& others,
                                 const ProgressCallback& progress);

}  // namespace hamjet
