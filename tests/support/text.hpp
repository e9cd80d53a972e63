#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hamjet::test {

/// Replaces a text, which must occur, by another one.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  if (position == std::string::npos) throw std::logic_error("not in the text: " + from);
  return text.replace(position, from.size(), to);
}

/// The number of times that a part occurs in a text.
inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

/// The characters of the widest line, each of UTF-8 counted once.
inline std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  std::size_t width = 0;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    width = c == '\n' ? 0 : width + (continues ? 0 : 1);
    widest = std::max(widest, width);
  }
  return widest;
}

/// A text as it was before its lines were broken for a terminal.
inline std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool is_blank = c == '\n' || c == ' ';
    if (!is_blank || line.empty() || line.back() != ' ') line += is_blank ? ' ' : c;
  }
  return line;
}

/// A text whose lines may be broken anywhere between its words, as one line.
inline std::string unwrapped(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  while (words >> word) result += (result.empty() ? "" : " ") + word;
  return result;
}

}  // namespace hamjet::test
