#pragma once

#include <vector>

#include "../../studies/paper/energy_conservation.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

/// Energy errors along time, and the step size along time.
std::vector<Chart> energy_conservation_charts(const EnergyConservationResult& result);

}  // namespace hamjet::io
