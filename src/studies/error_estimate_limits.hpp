#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// A degree whose rounding is larger has fewer than three digits, and is none.
inline constexpr double largest_delivered_rounding = 1e-3;

/// By degree, the estimate of the error that the check error-estimate allows a run, see
/// self_checks; empty where the steps are fixed, which promise nothing, and the scene sets no
/// limit.
std::vector<double> error_estimate_limits(const Scene& scene, const RunResult& run);

/// Whether an estimate is beyond any of the limits. What is not finite is.
bool exceeds_limits(const std::vector<double>& estimate, const std::vector<double>& limits);

}  // namespace hamjet
