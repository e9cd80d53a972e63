#pragma once

#include <string_view>

namespace hamjet::io {

/// The unit for which the end of a key's name stands; empty for no unit.
std::string_view unit_of(std::string_view name);

/// The name without its unit: "position" of "position_m".
std::string_view without_unit(std::string_view name);

}  // namespace hamjet::io
