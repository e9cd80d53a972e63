#pragma once

#include <string>

#include "hamjet/studies/scene.hpp"

// The tolerances that scenes may ask for, and the integrator of a scene that names none.

namespace hamjet::io {

/// The range of tolerances in double precision.
inline constexpr double least_tolerance = 1e-15;
inline constexpr double greatest_tolerance = 1e-1;
/// The least tolerance in extended precision.
inline constexpr double least_extended_tolerance = 1e-30;

/// The label of an integrator to which the scene gives none.
std::string default_label(const IntegratorSettings& settings);

/// The integrator of a scene without tables `[[integrator]]`: an orbit is expanded to about the
/// tolerance, at every degree.
IntegratorSettings default_integrator();

/// The description of this integrator, for people.
const std::string& default_integrator_text();

/// This integrator as a table `[[integrator]]`, in TOML.
const std::string& default_integrator_table();

}  // namespace hamjet::io
