#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Text of users, files and messages may hold characters that move a terminal's cursor, set its
// title, or turn the order of what follows; these are escaped wherever it is shown.

namespace hamjet::io {

/// `text` on one line and in valid UTF-8: control and format characters (the categories Cc and Cf
/// of Unicode), line separators and bytes that are not UTF-8 are escaped, and what goes beyond
/// `most_characters` as shown is cut off with "...".
std::string printable(std::string_view text, std::size_t most_characters = 80);

/// The same of a text of several lines, whole.
std::string printable_lines(std::string_view text);

/// A text in printable form, in double quotes.
std::string in_quotes(std::string_view text);

/// A JSON text with such characters as its own escapes, which leaves its meaning as it is.
std::string printable_json(std::string_view json);

/// Length of the well-formed UTF-8 sequence at the start of `text`, or 0 if there is none. (The
/// Unicode Standard, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF.)
std::size_t utf8_sequence_length(std::string_view text);

}  // namespace hamjet::io
