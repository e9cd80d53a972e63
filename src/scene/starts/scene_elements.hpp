#pragma once

#include <string_view>
#include <vector>

#include "../tables/scene_table.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "scene_nominal_file.hpp"

// The state of a satellite from osculating elements. Size and shape of the ellipse, and the place
// on it, may be given in several ways.

namespace hamjet::io {

/// The keys of read_elements, which belong to `owners`.
std::vector<SceneKey> element_keys(const std::vector<std::string_view>& owners = {});

/// The keys among these that give the size of the ellipse; an orbit in elements has at least one of
/// them.
const std::vector<std::string_view>& size_keys();

/// The keys among these that give the place on the ellipse; an orbit in elements has one of them.
const std::vector<std::string_view>& place_keys();

/// The state that the elements give, without rounding of the elements. Throws Error(scene).
CartesianState read_elements(const TableReader& table, const SceneCentre& centre);

}  // namespace hamjet::io
