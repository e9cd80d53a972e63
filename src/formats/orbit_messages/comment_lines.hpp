#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// The text of a comment, broken into lines for CCSDS messages. With the keyword COMMENT no line is
/// longer than the 254 characters of the standards (502.0-B-3, 7.3.2; 508.0-B-1, 6.3.1). Lines are
/// broken at blanks where there are any.
inline std::vector<std::string_view> comment_lines(std::string_view rest) {
  constexpr std::size_t longest = 254 - std::string_view("COMMENT ").size();
  std::vector<std::string_view> lines;
  while (!rest.empty()) {
    std::size_t length = std::min(rest.size(), longest);
    if (length < rest.size()) {
      const std::size_t blank = rest.rfind(' ', length);
      if (blank != std::string_view::npos && blank > 0) length = blank;
    }
    lines.push_back(rest.substr(0, length));
    rest.remove_prefix(length);
    if (rest.starts_with(' ')) rest.remove_prefix(1);
  }
  return lines;
}

}  // namespace hamjet::io
