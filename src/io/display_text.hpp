#pragma once

#include <string>
#include <string_view>

namespace hamjet::io {

/// "12.3 ms", "4.56 km", "1.2 MB": three digits and a prefix, for people.
std::string duration_text(double seconds);
std::string length_text(double metres);
std::string memory_text(double bytes);
std::string count_text(double count);

/// A text as HTML or XML shows it literally, in elements and in attributes.
std::string escape_html(std::string_view text);

}  // namespace hamjet::io
