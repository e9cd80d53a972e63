#pragma once

#include <vector>

#include "../drawing/chart.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet::io {

/// All plots of a comparison, in the order of the page, fitted.
std::vector<Chart> comparison_charts(const ComparisonResult& result);

// The parts that comparison_charts is made of, not fitted.
Chart work_precision_chart(const ComparisonResult& result);
Chart exactness_chart(const ComparisonResult& result);
Chart symplecticity_chart(const ComparisonResult& result);
Chart cost_chart(const ComparisonResult& result);
Chart convergence_chart(const ComparisonResult& result);

}  // namespace hamjet::io
