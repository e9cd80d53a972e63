#pragma once

#include "../tables/scene_table.hpp"
#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The keys of `[system]` that name the field's file and what to do with it.
std::vector<SceneKey> earth_field_keys();

/// Reads the field of the model `earth` to the degree and order of `earth`, with its mu and radius:
/// from the file that the scene names, or EGM96 to degree 20. Coefficients that vary with time are
/// taken at `epoch`. Throws Error(scene), and as parse_harmonic_field.
void read_earth_field(const TableReader& system, const Epoch& epoch, SystemSettings& settings,
                      EarthSettings& earth);

}  // namespace hamjet::io
