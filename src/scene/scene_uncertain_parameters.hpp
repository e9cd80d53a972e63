#pragma once

#include <optional>
#include <vector>

#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "hamjet/studies/scene.hpp"
#include "tables/scene_table.hpp"

namespace hamjet::io {

/// The keys by which a table of uncertainty tells parameters of the forces.
std::vector<SceneKey> uncertain_parameter_keys();

/// C_D A / m (`is_drag`) or C_R A / m of the chief or the deputy; none without the force.
std::optional<double> coefficient_of_owner(const Scene& scene, bool is_deputy, bool is_drag);

/// Whether a table tells such parameters.
bool has_uncertain_parameters(const TableReader& table);

/// Reads the parameters of a spacecraft into `state`, whose own covariance is known already, and
/// those that all spacecraft share into `common`; if this is null, the table is a deputy's, which
/// has none of these. Parameters that are known exactly are left out. Throws Error(scene).
void read_uncertain_parameters(const TableReader& table, const Scene& scene,
                               StateUncertainty& state, std::vector<UncertainParameter>* common);

}  // namespace hamjet::io
