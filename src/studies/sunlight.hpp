#pragma once

#include <memory>
#include <vector>

#include "../astronomy/sunlight.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The light along the orbit from a state (q, p), perhaps with parameters, which stands where the
/// clock of the model `earth` is 0: from a quarter of a day before the settings' span to as much
/// after it. The orbit is flown once, with all of its forces. Edges are found as it meets them, and
/// where a part of the disc is covered it is flown again with the light that it has found. The
/// Earth's shadow is that of a sphere of the field's radius. Throws Error(numerical) if the orbit
/// runs into the centre within the span.
std::shared_ptr<const Sunlight> sunlight_along(const SystemSettings& settings,
                                               double canonical_radius,
                                               const std::vector<double>& state);

/// Sets the light along the nominal of a scene whose Earth keeps the Sun's light off; it does
/// nothing for other scenes.
void light_nominal(Scene& scene);

}  // namespace hamjet
