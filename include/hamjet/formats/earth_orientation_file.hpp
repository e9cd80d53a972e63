#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "hamjet/astronomy/earth_orientation.hpp"

namespace hamjet::io {

/// Largest file of Earth orientation that is read, in bytes: all days since 1973 take 4 MB.
inline constexpr std::size_t largest_earth_orientation_bytes = std::size_t{1} << 26;

/// Reads a table of the IERS in the format finals2000A (finals2000A.all, .data or .daily): a day in
/// each line, fixed columns. Of each day the final values of Bulletin B are taken, or where these
/// are missing those of Bulletin A, measured or predicted; days at the end without values are left
/// out. Celestial pole offsets that are missing count as zero. `name` is the file's, for messages.
/// Throws Error(input_output) with one line `name:line: what` for other text: a day that is not
/// that of the calendar beside it, a value that is no number or beyond what the Earth does, days
/// that do not ascend, no two days in succession. Source: readme.finals2000A of the IERS Rapid
/// Service/Prediction Centre.
EarthOrientation read_earth_orientation(const std::string& name, std::string_view text);

}  // namespace hamjet::io
