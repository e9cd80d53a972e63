#pragma once

#include <vector>

#include "../drawing/chart.hpp"
#include "hamjet/studies/energy_conservation.hpp"

namespace hamjet::io {

/// Energy errors along time, and the step size along time.
std::vector<Chart> energy_conservation_charts(const EnergyConservationResult& result);

}  // namespace hamjet::io
