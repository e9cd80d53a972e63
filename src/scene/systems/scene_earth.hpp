#pragma once

#include <string_view>
#include <vector>

#include "../starts/scene_nominal_file.hpp"
#include "../tables/scene_table.hpp"
#include "hamjet/astronomy/instant.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"

// The model `earth`: the keys of [system] and [nominal] that say which forces act, at which moment
// the scene starts, and in which axes its orbits are given.

namespace hamjet::io {

/// The keys of `[system]` that belong to the model, beside those of a gravity file.
std::vector<SceneKey> earth_keys();
/// The keys of `[nominal]`: the epoch, with its time system, and the axes.
std::vector<SceneKey> epoch_keys();

/// Reads these keys of the tables `[system]` and `[nominal]`. Throws Error(scene), and
/// Error(input_output) for files.
void read_earth(const TableReader& root, SystemSettings& settings);

/// Refuses the keys of epoch and axes for the other models.
void refuse_epoch_keys(const TableReader& nominal, const SystemSettings& system);

/// The state of an orbit along the axes in which it is flown, those of GCRF. The orbit was read
/// from `table`: from a message, in its own axes, or from keys, in those of the scene.
CartesianState in_gcrf(const TableReader& table, const CartesianState& state,
                       const std::optional<NominalFile>& file, const EarthSettings& earth);

/// Whether a date is the moment at which the scene starts, whatever its time system.
bool is_at_start(const EarthSettings& earth, const Epoch& epoch, std::string_view time_system);

/// What orbit messages of the scene say of its date and axes.
EphemerisSettings ephemeris_of_earth(const TableReader& root);

/// Refuses the studies and coordinates that need a flow which is the same at every start: flow
/// boxes, frozen orbits and deputies that stay, polynomials of events, the shift in time left out.
void refuse_fixed_flows(const TableReader& root, const Scene& scene);

/// Sets the span in which the scene flies, from what has been read of it. Throws Error(scene) for a
/// span that leaves the dates of the Earth's orientation, or those at which Sun, Moon and axes are
/// known.
void set_span_of_earth(const TableReader& root, Scene& scene);

}  // namespace hamjet::io
