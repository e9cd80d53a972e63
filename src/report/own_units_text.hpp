#pragma once

#include <fmt/format.h>

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

/// What momenta and energies of 1 are, in a line of its own; empty where the scene says no mass.
inline std::string own_mass_line(const Scene& scene) {
  if (!scene.mass_kg) return "";
  const CanonicalUnits& units = scene.units;
  return fmt::format(
      "a mass of 1 is {:.6g} kg, a momentum of 1 {:.6g} kg m/s (of a length), an energy of 1 "
      "{:.6g} J\n",
      *scene.mass_kg, momentum_kg_m_s(units, *scene.mass_kg), energy_J(units, *scene.mass_kg));
}

}  // namespace hamjet::io
