#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>

namespace hamjet::io {

/// The place where a TOML text first defines what it defines again at `second`, which is the place
/// that toml++ gives for the error. No value if the first place cannot be found, for example within
/// an inline table.
std::optional<toml::source_position> first_definition(std::string_view text,
                                                      const toml::source_position& second);

}  // namespace hamjet::io
