#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Follows a problem's nominal in extended precision, with Gauss of 16 stages and this tolerance,
/// to each of the times in turn (canonical, moving away from 0). `visit` is called with the index
/// of the time and the state of the computed components; `on_step`, if present, with the time of
/// every step. Throws as integrate_gauss, `visit` and `on_step` do.
void follow_nominal(
    const ComputedProblem& problem, const std::vector<double>& times, double tolerance,
    const std::function<void(std::size_t index, const std::vector<Extended>& state)>& visit,
    const std::function<void(double time)>& on_step = {});

}  // namespace hamjet
