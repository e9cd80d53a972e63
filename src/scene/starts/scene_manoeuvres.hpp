#pragma once

#include <optional>
#include <vector>

#include "../scene_sections.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {

/// The key that says what becomes of the manoeuvres of a table's orbit message.
SceneKey manoeuvres_key(const std::vector<std::string_view>& owners = {});

/// The manoeuvres of the OPM that a table names, from its EPOCH on, in the canonical units of
/// `scale`; none for a table without one, and where its key `manoeuvres` leaves them out. Throws
/// Error(scene) for a manoeuvre before EPOCH or before the one above it ends, along axes that are
/// not those of the state, or of a mass that is not told or runs out.
std::vector<Manoeuvre> read_manoeuvres(const TableReader& table, const SystemSettings& system,
                                       const CanonicalScale& scale);

/// Refuses an OPM with manoeuvres where the study makes the velocity changes itself.
void refuse_manoeuvres(const TableReader& table);

}  // namespace hamjet::io
