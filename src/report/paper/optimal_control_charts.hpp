#pragma once

#include <vector>

#include "../drawing/chart.hpp"
#include "hamjet/studies/optimal_control_study.hpp"

namespace hamjet::io {

/// The trajectory in the plane of the first two states, the controls along time, and the cost's
/// error against the step where there is a closed form.
std::vector<Chart> optimal_control_charts(const OptimalControlResult& result);

}  // namespace hamjet::io
