#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "../scene/tables/scene_table.hpp"

namespace hamjet::io {

/// A value as --set takes it. The text "null" alone removes the key, as it does there.
std::string override_text(const toml::node& value);

/// The keys of a table with those of the tables in it, dotted, and their values, in the order of
/// the text: `nominal.e = 0.1` and `"nominal.e" = 0.1` are the same.
std::vector<std::pair<std::string, const toml::node*>> flat_keys(const toml::table& table);

/// The values along an axis: as they are listed, or `count` from `from` to `to`, both included, the
/// nearest binary64 numbers to what decimal arithmetic gives: 0.3, not 0.30000000000000004. `count`
/// may be at most `most_values`.
std::vector<std::string> axis_values(const TableReader& axis, const toml::table& table,
                                     std::size_t most_values);

}  // namespace hamjet::io
