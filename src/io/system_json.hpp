#pragma once

#include <hamjet/studies/scene.hpp>
#include <nlohmann/json.hpp>

namespace hamjet::io {

/// What an orbit's gravity field is made of: mu, the radius, each J_n that is present, and the file
/// that they come from, if they do. Null for the models that are no orbits.
nlohmann::ordered_json system_json(const SystemSettings& system);

}  // namespace hamjet::io
