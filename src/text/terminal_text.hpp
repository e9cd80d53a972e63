#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// The characters in a line of the terminal that tables and explanations keep to.
inline constexpr std::size_t terminal_width = 80;

/// The places that a text takes: bytes that continue a character of UTF-8 take none.
std::size_t text_width(std::string_view text);

/// The text in printable form, with lines that are too long broken between words. What follows
/// begins under the value of a line "  name    value", else under the line's own beginning. A
/// longer word stays whole, for it may be a path, and so does a number with its unit.
std::string fitted(std::string_view given, std::size_t width = terminal_width);

/// Rows with the headings first, under each other: the first column to the left, the others to the
/// right. An empty cell was not computed and is shown as "-"; a column of such cells is left out.
/// Columns that do not fit beside the others follow in another table below, with the first column
/// again. Long words in the first column lose their middle.
std::string aligned_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace hamjet::io
