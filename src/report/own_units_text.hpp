#pragma once

#include <string>

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// What metres and seconds are in the results of a scene's own system that says nothing of its
/// units; empty for any other.
inline std::string own_units_text(const Scene& scene) {
  const CanonicalUnits& units = told_units(scene);
  const bool is_unsaid = units.length_km == 0.001 && units.time_s == 1;
  if (scene.system.model != SystemModel::own || !is_unsaid) return "";
  return "m and s are the system's own units of length and time, without [units] in the scene";
}

}  // namespace hamjet::io
