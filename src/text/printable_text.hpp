#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Text of users, files and messages may hold characters that move a terminal's cursor, set its
// title, or turn the order of what follows. The functions below escape these characters wherever
// such text is shown.

namespace hamjet::io {

/// `text` on one line and in valid UTF-8: control and format characters (the categories Cc and Cf
/// of Unicode), line separators and bytes that are not UTF-8 are escaped. A text that takes more
/// than `most_characters` when shown is cut off with "...".
std::string printable(std::string_view text, std::size_t most_characters = 80);

/// As `printable`, for a text of several lines, which is never cut off.
std::string printable_lines(std::string_view text);

/// A text in printable form, in double quotes.
std::string in_quotes(std::string_view text);

/// A JSON text in which these characters are written as JSON escapes, so that its meaning stays.
std::string printable_json(std::string_view json);

/// Length of the well-formed UTF-8 sequence at the start of `text`, or 0 if there is none. (The
/// Unicode Standard, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF.)
std::size_t utf8_sequence_length(std::string_view text);

}  // namespace hamjet::io
