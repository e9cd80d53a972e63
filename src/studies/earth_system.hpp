#pragma once

#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The system of the model `earth` in canonical units, in which the field's radius is
/// `canonical_radius` and mu is 1; its clock is 0 at the scene's epoch. Throws as EarthRotation and
/// BodyPosition.
DynamicalSystem earth_system(const SystemSettings& settings, double canonical_radius);

}  // namespace hamjet
