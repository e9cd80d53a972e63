#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "table_description.hpp"

namespace hamjet::io {

/// All keys of a scene, and of a study of `hamjet sweep`, with unit, range and default as a page in
/// Markdown, from what the tables declare. data/scenes/keys/README.md holds it.
std::string key_reference(const TableDescription& sweep_study);

/// The section of that page on one table, by its path ("uncertainty.collision", with brackets or
/// without) or on all keys of one name; nothing if scenes have neither.
std::optional<std::string> section_on_keys(std::string_view name);

}  // namespace hamjet::io
