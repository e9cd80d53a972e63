#pragma once

#include "../companion_flow.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The thrust of least fuel below the acceleration of the scene's thruster, which stays the same,
/// for at most twelve of the times at which energy-optimal thrust was found, beside the least
/// impulses for each (see bang_bang_thrust).
FuelOptimalTransfers fuel_optimal_transfers(const Scene& scene, const ComputedProblem& orbit,
                                            const CompanionFlow& flow,
                                            const EnergyOptimalTransfers& energy,
                                            const ProgressCallback& progress);

}  // namespace hamjet
