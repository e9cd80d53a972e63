#pragma once

#include <optional>

#include "../tables/scene_table.hpp"
#include "hamjet/detail/studies/system_settings.hpp"

// In what spacecraft differ: the table [spacecraft] is the chief's, [deputy.spacecraft] the
// deputy's. All functions throw Error(scene).

namespace hamjet::io {

/// What a table says of a spacecraft: C_D A / m and C_R A / m, in m^2/kg; no value where the force
/// is none of the scene's, or a deputy leaves it to its chief.
struct SpacecraftSettings {
  std::optional<double> drag_m2_kg = {};
  std::optional<double> radiation_m2_kg = {};
  SpacecraftParts parts = {};  ///< what they are made of, as far as it is told
};

/// The keys of `[system]` about the air and the light of the model `earth`.
std::vector<SceneKey> surface_force_keys();

/// Reads air and light of the model `earth`, the chief's coefficients (of [spacecraft], or else of
/// the nominal's OPM, or of the CDM of [uncertainty]), and the names of the
/// parameters in which `[jet]` expands. Refuses a table [spacecraft] of other models.
void read_surface_forces(const TableReader& root, SystemSettings& system);

/// Whether the chief's coefficients are those of the nominal's OPM.
bool uses_message_of_spacecraft(const TableReader& root, const SystemSettings& system);

/// What the CDM of `[uncertainty.deputy]` says of the deputy, in a scene without [spacecraft].
SpacecraftSettings spacecraft_of_conjunction(const TableReader& root, const SystemSettings& system);

/// The table `spacecraft` in the table of a deputy, or else what its own OPM says.
SpacecraftSettings read_spacecraft(const TableReader& owner, const SystemSettings& system);

}  // namespace hamjet::io
