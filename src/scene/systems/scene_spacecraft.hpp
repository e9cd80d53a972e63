#pragma once

#include <optional>

#include "../tables/scene_table.hpp"
#include "hamjet/detail/studies/system_settings.hpp"

// In what spacecraft differ: the table [spacecraft] is the chief's, [deputy.spacecraft] the
// deputy's. All functions throw Error(scene).

namespace hamjet::io {

/// The keys of `[system]` about the air of the model `earth`.
std::vector<SceneKey> atmosphere_keys();

/// Reads the air of the model `earth`, the chief's coefficient, and the names of the parameters in
/// which `[jet]` expands. Refuses a table [spacecraft] of other models.
void read_drag(const TableReader& root, SystemSettings& system);

/// The C_D A / m, in m^2/kg, of the table `spacecraft` in a table; no value where it has none.
std::optional<double> read_spacecraft(const TableReader& owner, const SystemSettings& system);

}  // namespace hamjet::io
