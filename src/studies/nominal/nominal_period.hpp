#pragma once

#include <optional>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Period of the nominal, in canonical units: that of the osculating Kepler ellipse at the start,
/// or of the oscillator. No value for an orbit that is not elliptic.
std::optional<double> nominal_period(const Scene& scene);

}  // namespace hamjet
