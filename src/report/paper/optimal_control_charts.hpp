#pragma once

#include <vector>

#include "../../studies/paper/optimal_control_study.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

/// The trajectory in the plane of the first two states, the controls along time, and the cost's
/// error against the step where there is a closed form.
std::vector<Chart> optimal_control_charts(const OptimalControlResult& result);

}  // namespace hamjet::io
