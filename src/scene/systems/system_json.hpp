#pragma once

#include <nlohmann/json.hpp>

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The parameters of a model. For an orbit they define the gravity field: mu, the radius, each J_n
/// that is present, and the file from which they come, if any. For another model they are the keys
/// of its table `[system]` with their values, defaults included.
nlohmann::ordered_json system_json(const SystemSettings& system);

/// What lengths and times of 1 mean and, where the scene says what a mass is, momenta and energies.
nlohmann::ordered_json units_json(const CanonicalUnits& units,
                                  const std::optional<double>& mass_kg = {});

/// All members of the settings by name; parameters of other methods are null.
nlohmann::ordered_json integrator_json(const IntegratorSettings& settings);

/// The members `ephemeris` and `nominal_file` of a summary; null where the scene has none.
nlohmann::ordered_json ephemeris_json(const Scene& scene);
nlohmann::ordered_json nominal_file_json(const Scene& scene);

}  // namespace hamjet::io
