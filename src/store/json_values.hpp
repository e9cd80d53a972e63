#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../studies/descriptions/settings_fields.hpp"

namespace hamjet::io {

/// A number; JSON has no infinite ones, which become the strings "inf", "-inf" and "nan".
inline nlohmann::ordered_json json_number(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}
inline nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : nlohmann::ordered_json(nullptr);
}

/// A value, or null where none was computed.
template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// A reason; an empty one becomes null.
inline nlohmann::ordered_json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

/// An enumerator by its name, a number by json_number, and what has no value as null.
template <class Value>
nlohmann::ordered_json json_value(const Value& value) {
  if constexpr (NamedEnumeration<Value>) {
    return names_of(value)[static_cast<std::size_t>(value)];
  } else if constexpr (requires { json_number(value); } && !std::is_integral_v<Value>) {
    return json_number(value);
  } else {
    return value;
  }
}
template <class Value>
nlohmann::ordered_json json_value(const std::vector<Value>& values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Value& value : values) json.push_back(json_value(value));
  return json;
}

/// All members of the settings by their names.
template <HasFields Settings>
nlohmann::ordered_json fields_json(const Settings& settings) {
  nlohmann::ordered_json json;
  for_each_field(settings, [&](std::string_view name, const auto& member) {
    json[std::string(name)] = json_value(member);
  });
  return json;
}

}  // namespace hamjet::io
