#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>

namespace hamjet::io {

/// Where a TOML text first defines what it may not define again at `second`, the place that
/// toml++ gives for the error. Nothing if that cannot be told, as within an inline table.
std::optional<toml::source_position> first_definition(std::string_view text,
                                                      const toml::source_position& second);

}  // namespace hamjet::io
