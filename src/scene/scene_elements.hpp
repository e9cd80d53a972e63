#pragma once

#include <string_view>
#include <vector>

#include "hamjet/dynamics/osculating_elements.hpp"
#include "scene_nominal_file.hpp"
#include "tables/scene_table.hpp"

// The state of a satellite by osculating elements, of which size and shape, and the place on the
// ellipse, may be said in several ways.

namespace hamjet::io {

/// The keys of read_elements, which belong to `owners`.
std::vector<SceneKey> element_keys(const std::vector<std::string_view>& owners = {});

/// Those of them that say the size of the ellipse: an orbit by elements has one at least.
const std::vector<std::string_view>& size_keys();

/// Those of them that say the place on the ellipse, of which an orbit has one.
const std::vector<std::string_view>& place_keys();

/// The state by elements, of which none is rounded. Throws Error(scene).
CartesianState read_elements(const TableReader& table, const SceneCentre& centre);

}  // namespace hamjet::io
