#pragma once

#include <vector>

#include "hamjet/studies/comparison.hpp"

namespace hamjet {

/// Fits the orders of convergence of the series with fixed steps, on the nominal and on the
/// highest degree, from the finest runs that lie well above the rounding floor. A series with too
/// few of them, or whose errors do not yet follow a power of the step, has no fit.
std::vector<ConvergenceFit> convergence_fits(const ComparisonResult& result,
                                             const std::vector<CandidateSeries>& series);

}  // namespace hamjet
