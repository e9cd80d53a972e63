#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// The width in characters to which tables and explanations on the terminal keep.
inline constexpr std::size_t terminal_width = 80;

/// The number of places that a text takes on the terminal: bytes that continue a UTF-8 character
/// take none.
std::size_t text_width(std::string_view text);

/// The text in printable form, with lines that are too long broken between words. In a line "  name
/// value" the continuation begins under the value, in other lines under the beginning of the line.
/// A word that is longer than the line stays whole, for it may be a path, and so does a number with
/// its unit.
std::string fitted(std::string_view given, std::size_t width = terminal_width);

/// A table with the headings in its first row. The first column is aligned to the left, the others
/// to the right. An empty cell was not computed and is shown as "-"; a column of empty cells is
/// left out. Columns that do not fit beside the others follow in another table below, which repeats
/// the first column. Long words in the first column lose their middle.
std::string aligned_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace hamjet::io
