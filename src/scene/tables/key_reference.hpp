#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "table_description.hpp"

namespace hamjet::io {

/// A page in Markdown with all keys of a scene, and of a study of `hamjet sweep`, with unit, range
/// and default, from the declarations of the tables. data/scenes/keys/README.md holds this page.
std::string key_reference(const TableDescription& sweep_study);

/// The section of that page about one table, by its path ("uncertainty.collision", with brackets or
/// without), or about all keys of one name; no value if scenes have neither.
std::optional<std::string> section_on_keys(std::string_view name);

}  // namespace hamjet::io
