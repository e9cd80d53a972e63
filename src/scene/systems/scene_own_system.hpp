#pragma once

#include <vector>

#include "../tables/scene_table.hpp"
#include "hamjet/studies/scene.hpp"

// The model `own`: a system whose scene writes its Hamiltonian or its vector field.

namespace hamjet::io {

/// The keys of `[system]` that belong to the model.
std::vector<SceneKey> own_keys();

/// Reads these keys. Parameters that `jet.variables` names end the states. Throws Error(scene) for
/// what is wrong in the text of the system.
void read_own_system(const TableReader& root, SystemSettings& settings);

/// Makes the system that the scene writes, if it does, and warns of likely mistakes in it. Throws
/// Error(scene) if it has no finite values at the nominal's start.
void set_own_system(const TableReader& root, Scene& scene);

}  // namespace hamjet::io
