#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace hamjet::io {

/// The whole text as a number, as std::from_chars takes it, if it is one.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace hamjet::io
