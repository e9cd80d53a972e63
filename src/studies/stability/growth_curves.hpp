#pragma once

#include <functional>
#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "stability.hpp"

namespace hamjet {

/// The growth of error, energy error and coefficients of a scene's first integrator over its
/// duration, with the expected growth. The nominal's error is relative to an integration in
/// extended precision from the same binary64 numbers; it is fitted where it exceeds the round-off
/// of a single addition. Throws as the integration does.
std::vector<GrowthCurve> growth_curves(const Scene& scene, const ComputedProblem& problem,
                                       const GrowthExpectation& expected,
                                       const std::function<void(double)>& progress);

}  // namespace hamjet
