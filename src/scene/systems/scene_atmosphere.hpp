#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "../tables/scene_table.hpp"
#include "hamjet/detail/studies/system_settings.hpp"

namespace hamjet::io {

/// The keys of `[system]` about the air of the model `earth`.
std::vector<SceneKey> atmosphere_keys();

/// Reads the air of the model `earth`, if there is any. Throws Error(scene), and
/// Error(input_output) as reading the file of a table does.
void read_air(const TableReader& system, EarthSettings& earth);

/// Refuses keys that stand without the one that they describe.
void refuse_alone(const TableReader& table, std::initializer_list<std::string_view> keys,
                  std::string_view what, std::string_view other);

}  // namespace hamjet::io
