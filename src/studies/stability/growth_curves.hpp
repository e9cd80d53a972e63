#pragma once

#include <functional>
#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "stability.hpp"

namespace hamjet {

/// How error, energy error and coefficients of a scene's first integrator grow over its duration,
/// beside what is expected. The nominal's error is against an integration in extended precision
/// that starts from the same binary64 numbers; it is fitted where it exceeds round-off of a single
/// addition. Throws as the integration does.
std::vector<GrowthCurve> growth_curves(const Scene& scene, const ComputedProblem& problem,
                                       const GrowthExpectation& expected,
                                       const std::function<void(double)>& progress);

}  // namespace hamjet
