#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace hamjet::io {

/// The number that the whole text spells, in the form that std::from_chars reads; no value for
/// other text.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace hamjet::io
