#pragma once

#include <vector>

#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Whether chief or deputy have manoeuvres.
bool has_manoeuvres(const Scene& scene);
/// Throws Error(scene) if chief or deputy have manoeuvres, which not every study flies.
void require_coasting(const Scene& scene);

/// The scene without the manoeuvres of its orbit messages.
Scene without_manoeuvres(Scene scene);

/// The state behind an impulse.
std::vector<double> behind_impulse(std::vector<double> state, const Manoeuvre& impulse);

/// The state after a part of a burn, from one time to another of those in which it burns (both
/// since the scene's start), with the full equations of motion. `state` stands at the first. Throws
/// as exact_flow.
std::vector<double> burnt_flow(const DynamicalSystem& system, std::vector<double> state,
                               const ClockTime& scene_start, const Manoeuvre& burn, double from,
                               double to);

}  // namespace hamjet
