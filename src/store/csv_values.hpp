#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

namespace hamjet::io {

/// A field in the form of RFC 4180: in quotes if a character in it would end the field.
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

/// A number with 17 digits, which bring back the same number; empty for no value.
inline std::string csv_number(double value) { return fmt::format("{:.17g}", value); }
inline std::string csv_number(const std::optional<double>& value) {
  return value ? csv_number(*value) : "";
}

}  // namespace hamjet::io
