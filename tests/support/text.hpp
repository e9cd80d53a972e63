#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace hamjet::test {

/// A text in place of another one, which must be there.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  if (position == std::string::npos) throw std::logic_error("not in the text: " + from);
  return text.replace(position, from.size(), to);
}

/// How often a part stands in a text.
inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

}  // namespace hamjet::test
