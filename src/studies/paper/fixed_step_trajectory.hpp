#pragma once

#include <vector>

#include "energy_conservation.hpp"

namespace hamjet {

/// The trajectory with fixed steps of this size, for comparison with that of `method`, up to the
/// time `end` or to a million steps. A numerical failure is recorded in the result.
FixedStepTrajectory fixed_step_trajectory(const DynamicalSystem& system,
                                          EnergyConservingMethod method,
                                          const std::vector<double>& start, double step, double end,
                                          const ProgressCallback& progress);

}  // namespace hamjet
