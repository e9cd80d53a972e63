#pragma once

#include "hamjet/detail/studies/energy_optimal.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The thrust of least energy for each of at most 48 of the scene's transfer times. One jet of the
/// flow of states and costates about the coasting chief (see costate_system) is propagated through
/// all of them; at each time its generating function F1 gives costates and cost for the ends by
/// evaluation. Each answer is flown, and corrected by flying. Throws Error(too_large) if the jets
/// would not fit the memory.
EnergyOptimalTransfers energy_optimal_transfers(const Scene& scene, const ComputedProblem& problem,
                                                const ProgressCallback& progress);

}  // namespace hamjet
