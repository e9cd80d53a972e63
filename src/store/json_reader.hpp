#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../studies/descriptions/settings_fields.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {

/// A value of a JSON file that hamjet wrote, together with its place in the file. Reading it as a
/// type that it does not have throws Error(input_output) with file and place.
class JsonReader {
 public:
  /// `file` is the file's name for messages. The JSON must outlive the reader.
  JsonReader(const nlohmann::json& json, std::string file, std::string path = {})
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  /// Parses a whole file, which must hold an object; `text` has no byte order mark.
  static nlohmann::json parse(std::string_view text, const std::string& file);

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::input_output, fmt::format("{}: {}: {}", file_, path_, what));
  }

  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }

  JsonReader at(std::string_view key) const {
    if (!json_->is_object()) fail("must be an object");
    const auto found = json_->find(key);
    const std::string path = fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", key);
    if (found == json_->end()) {
      throw Error(ErrorKind::input_output, fmt::format("{}: {}: is missing", file_, path));
    }
    return {*found, file_, path};
  }

  bool is_null() const { return json_->is_null(); }

  double number() const {
    if (json_->is_number()) return json_->get<double>();
    if (json_->is_string()) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const auto& text = json_->get_ref<const std::string&>();
      if (text == "inf") return infinity;
      if (text == "-inf") return -infinity;
      if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    }
    fail("must be a number, \"inf\", \"-inf\" or \"nan\"");
  }

  template <class Integer>
  Integer integer() const {
    if (!json_->is_number_integer()) fail("must be an integer");
    // The parser stores signed and unsigned numbers; both are compared without conversion.
    const bool is_unsigned = json_->is_number_unsigned();
    if (is_unsigned ? !std::in_range<Integer>(json_->get<std::uint64_t>())
                    : !std::in_range<Integer>(json_->get<std::int64_t>())) {
      fail("is out of range");
    }
    return json_->get<Integer>();
  }

  bool boolean() const {
    if (!json_->is_boolean()) fail("must be true or false");
    return json_->get<bool>();
  }

  std::string text() const {
    if (!json_->is_string()) fail("must be a string");
    return json_->get<std::string>();
  }

  std::string text_or_empty() const { return is_null() ? std::string() : text(); }

  std::optional<double> optional_number() const {
    return is_null() ? std::nullopt : std::optional(number());
  }

  template <class Read>
  auto list(Read read) const {
    if (!json_->is_array()) fail("must be an array");
    std::vector<decltype(read(*this))> values;
    values.reserve(json_->size());
    for (std::size_t i = 0; i < json_->size(); ++i) {
      values.push_back(read(JsonReader((*json_)[i], file_, fmt::format("{}[{}]", path_, i))));
    }
    return values;
  }

  std::vector<double> numbers() const {
    return list([](const JsonReader& value) { return value.number(); });
  }

  /// Reads a value that json_value has written.
  void read_into(double& value) const { value = number(); }
  void read_into(std::optional<double>& value) const { value = optional_number(); }
  void read_into(int& value) const { value = integer<int>(); }
  void read_into(bool& value) const { value = boolean(); }
  void read_into(std::string& value) const { value = text(); }
  template <NamedEnumeration Enumeration>
  void read_into(Enumeration& value) const {
    value = one_of<Enumeration>(names_of(value));
  }

  /// Reads settings that fields_json or integrator_json has written; null leaves the default.
  template <HasFields Settings>
  Settings fields() const {
    Settings settings;
    for_each_field(settings, [&](std::string_view name, auto& member) {
      if (!at(name).is_null()) at(name).read_into(member);
    });
    return settings;
  }

  /// The index of this text in `names`.
  std::size_t index_in(const std::vector<std::string_view>& names) const {
    const auto found = std::find(names.begin(), names.end(), text());
    if (found == names.end()) fail("must be one of the known names");
    return static_cast<std::size_t>(found - names.begin());
  }

  /// The enumerator of this name.
  template <class Enumeration>
  Enumeration one_of(const std::vector<std::string_view>& names) const {
    return static_cast<Enumeration>(index_in(names));
  }

 private:
  const nlohmann::json* json_;
  std::string file_;
  std::string path_;
};

inline nlohmann::json JsonReader::parse(std::string_view text, const std::string& file) {
  const auto refuse = [&](const std::string& path, const std::string& what) {
    throw Error(ErrorKind::input_output, fmt::format("{}: {}: {}", file, path, what));
  };
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string_view before = text.substr(0, error.byte);
    refuse(fmt::format("line {}", 1 + std::count(before.begin(), before.end(), '\n')),
           "is not valid JSON");
  } catch (const nlohmann::json::exception&) {
    // The parser throws different exceptions for a number beyond the range of a double and for a
    // wrong character.
    refuse("a number", "is out of range");
  }
  if (!json.is_object()) refuse("the file", "must be an object");
  return json;
}

}  // namespace hamjet::io
