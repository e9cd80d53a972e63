#pragma once

#include <vector>

#include "../../studies/bounded/bounded_formation.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

// None of these charts is fitted.

/// The mean drift along the track over the window against the size, for each rule.
Chart bounded_drift_chart(const BoundedFormation& formation);

/// The relative orbits of the map's deputies in three projections, each divided by its size: over
/// the first revolution, and of the largest one over the last.
std::vector<Chart> bounded_orbit_charts(const BoundedFormation& formation);

}  // namespace hamjet::io
