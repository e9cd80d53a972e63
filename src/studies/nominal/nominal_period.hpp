#pragma once

#include <optional>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Period of the nominal, canonical: that of the osculating Kepler ellipse at the start, or of the
/// oscillator. None for an orbit that is not elliptic.
std::optional<double> nominal_period(const Scene& scene);

}  // namespace hamjet
