#include "scene_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../store/text_file.hpp"
#include "../../text/quantity_text.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {

std::string describe(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return fmt::format("the string {}", in_quotes(node.as_string()->get()));
    case toml::node_type::integer:
      return fmt::format("{}", node.as_integer()->get());
    case toml::node_type::floating_point: {
      const std::string number = fmt::format("{}", node.as_floating_point()->get());
      const bool like_integer = number.find_first_not_of("-0123456789") == std::string::npos;
      return like_integer ? number + ".0" : number;
    }
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    case toml::node_type::array:
      return node.as_array()->empty() ? "an empty array" : "an array";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

TableReader::TableReader(const toml::table& table, std::string path, const SceneSource& source,
                         const TableDescription* description, SceneErrors* errors)
    : table_(&table),
      path_(std::move(path)),
      source_(&source),
      description_(description),
      errors_(errors) {}

double TableReader::number(std::string_view key) const {
  if (description_ != nullptr) {
    const ValueForm& form = form_of(key);
    if (form.is_positive) return positive_number(key);
    if (form.has_range()) return number_between(key, form.least, form.most);
  }
  constexpr std::string_view right = "a finite number";
  return finite(required(key, right), dotted(key), right);
}

double TableReader::positive_number(std::string_view key) const {
  constexpr std::string_view right = "a number above 0";
  const double value = finite(required(key, right), dotted(key), right);
  if (!(value > 0)) fail(key, fmt::format("not positive, got {}, must be {}", found(key), right));
  return value;
}

double TableReader::number_between(std::string_view key, double least, double greatest) const {
  const std::string right = fmt::format("a number from {} to {}", least, greatest);
  const double value = finite(required(key, right), dotted(key), right);
  if (!(value >= least && value <= greatest)) {
    fail(key, fmt::format("out of range, got {}, must be {}", found(key), right));
  }
  return value;
}

std::int64_t TableReader::integer_between(std::string_view key, std::int64_t least,
                                          std::int64_t greatest) const {
  const std::string right = least == greatest
                                ? fmt::format("the integer {}", least)
                                : fmt::format("an integer from {} to {}", least, greatest);
  const toml::node& node = required(key, right);
  if (!node.is_integer()) {
    fail(key, fmt::format("wrong type, got {}, must be {}", found(key), right));
  }
  const std::int64_t value = node.as_integer()->get();
  if (value < least || value > greatest) {
    fail(key, fmt::format("out of range, got {}, must be {}", found(key), right));
  }
  return value;
}

std::optional<std::int64_t> TableReader::integer_if_any(std::string_view key) const {
  const auto* integer = table_->get_as<std::int64_t>(key);
  return integer != nullptr ? std::optional(integer->get()) : std::nullopt;
}

std::vector<double> TableReader::numbers(std::string_view key, std::size_t count) const {
  const std::string right = "an array of " + counted(count, "finite number");
  const toml::array& array = required_array(key, right);
  if (array.size() != count) {
    fail(key,
         fmt::format("wrong length, got {}, must be {}", counted(array.size(), "element"), right));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(finite(array[i], fmt::format("{}.{}", dotted(key), i), "a finite number"));
  }
  return values;
}

std::vector<double> TableReader::positive_numbers(std::string_view key, std::size_t count) const {
  std::vector<double> values = numbers(key, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (values[i] > 0) continue;
    fail_element(key, i, fmt::format("not positive, got {}, must be a number above 0", values[i]));
  }
  return values;
}

std::vector<double> TableReader::numbers(std::string_view key) const {
  constexpr std::string_view right = "an array of finite numbers, at least one";
  const std::size_t count = required_array(key, right).size();
  if (count == 0) fail(key, fmt::format("empty, got [], must be {}", right));
  return numbers(key, count);
}

std::vector<std::int64_t> TableReader::integers(std::string_view key, std::int64_t least,
                                                std::int64_t greatest) const {
  const std::vector<double> values = numbers(key);
  std::vector<std::int64_t> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (value != std::floor(value) || value < static_cast<double>(least) ||
        value > static_cast<double>(greatest)) {
      fail_element(key, i,
                   fmt::format("out of range, got {}, must be an integer from {} to {}", value,
                               least, greatest));
    }
    result.push_back(static_cast<std::int64_t>(value));
  }
  return result;
}

std::vector<double> TableReader::square_matrix(std::string_view key, std::size_t size) const {
  const std::string right = fmt::format("an array of {0} arrays of {0} finite numbers", size);
  const toml::array& rows = required_array(key, right);
  if (rows.size() != size) {
    fail(key, fmt::format("wrong size, got {}, must be {}", counted(rows.size(), "row"), right));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < size; ++i) {
    const toml::array* row = rows[i].as_array();
    if (row == nullptr || row->size() != size) {
      const std::string got = row == nullptr ? describe(rows[i]) : counted(row->size(), "element");
      fail_element(key, i, fmt::format("wrong size, got {}, the matrix must be {}", got, right));
    }
    for (std::size_t j = 0; j < size; ++j) {
      values.push_back(
          finite((*row)[j], fmt::format("{}.{}.{}", dotted(key), i, j), "a finite number"));
    }
  }
  return values;
}

std::vector<double> TableReader::number_or_numbers(std::string_view key) const {
  const bool is_one = table_->contains(key) && !table_->get(key)->is_array();
  return is_one ? std::vector<double>{number(key)} : numbers(key);
}

bool TableReader::boolean(std::string_view key) const {
  const toml::node& node = required(key, "true or false");
  if (!node.is_boolean()) {
    fail(key, fmt::format("wrong type, got {}, must be true or false", found(key)));
  }
  return node.as_boolean()->get();
}

std::optional<bool> TableReader::boolean_if_any(std::string_view key) const {
  const auto* boolean = table_->get_as<bool>(key);
  return boolean != nullptr ? std::optional(boolean->get()) : std::nullopt;
}

std::optional<std::string> TableReader::text_if_any(std::string_view key) const {
  const auto* text = table_->get_as<std::string>(key);
  return text != nullptr ? std::optional(text->get()) : std::nullopt;
}

bool TableReader::is_number(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && node->is_number();
}

std::string TableReader::text(std::string_view key) const {
  required(key, "a string");
  if (auto text = text_if_any(key)) return *std::move(text);
  fail(key, fmt::format("wrong type, got {}, must be a string", found(key)));
}

std::filesystem::path TableReader::path_beside_scene(std::string_view key) const {
  const std::string path = text(key);
  // The system would end the path at a NUL.
  if (path.empty() || path.find('\0') != std::string::npos) {
    fail(key, fmt::format("no path, got {}, must be the path of a file", found(key)));
  }
  return source_->folder / path;
}

std::string TableReader::content_beside_scene(std::string_view key, std::size_t most_bytes) const {
  const std::filesystem::path file = path_beside_scene(key);
  FileContent content = read_regular_file(file, most_bytes);
  if (!content.problem.empty()) {
    throw_no_content(
        file, content, content.is_too_large ? ErrorKind::too_large : ErrorKind::input_output,
        fmt::format("{}: {} cannot be read: {}", head(key), printable_path(file), content.problem));
  }
  return std::move(content.text);
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
  constexpr std::string_view right = "an array of strings, at least one";
  const toml::array& array = required_array(key, right);
  if (array.empty()) fail(key, fmt::format("empty, got [], must be {}", right));
  std::vector<std::string> values;
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!array[i].is_string()) {
      fail_element(key, i, fmt::format("wrong type, got {}, must be a string", describe(array[i])));
    }
    values.push_back(array[i].as_string()->get());
  }
  return values;
}

std::size_t TableReader::choice(std::string_view key,
                                const std::vector<std::string_view>& choices) const {
  const std::string right = fmt::format("one of: {}", listed(choices));
  required(key, right);
  const auto value = text_if_any(key);
  if (!value) fail(key, fmt::format("wrong type, got {}, must be {}", found(key), right));
  const auto match = std::find(choices.begin(), choices.end(), *value);
  if (match == choices.end()) {
    const auto near = nearest(*value, choices);
    fail(key, fmt::format("unknown value, got {}, must be {}{}", in_quotes(*value), right,
                          near ? fmt::format(" (did you mean {}?)", printable(*near)) : ""));
  }
  return static_cast<std::size_t>(match - choices.begin());
}

std::string_view TableReader::exactly_one_of(const std::vector<std::string_view>& keys) const {
  std::vector<std::string_view> given;
  for (const std::string_view key : keys) {
    if (has(key)) given.push_back(key);
  }
  if (given.empty()) {
    fail("",
         fmt::format("missing, got none of a choice, must be exactly one of: {}", listed(keys)));
  }
  if (given.size() > 1) {
    const std::string problem =
        fmt::format("more than one key of a choice, got {}, must be exactly one of: {}",
                    listed(given), listed(keys));
    for (const std::string_view key : given) {
      const std::string removal = removal_of_others(key, given);
      if (!removal.empty()) fail(key, problem + removal);
    }
    fail(given[1], problem);
  }
  return given[0];
}

TableReader TableReader::table(std::string_view key) const {
  const toml::node& node = required(key, "a table");
  if (!node.is_table()) {
    fail(key, fmt::format("wrong type, got {}, must be a table [{}]", found(key), dotted(key)));
  }
  return TableReader(*node.as_table(), dotted(key), *source_, description_of(key), errors_);
}

std::vector<TableReader> TableReader::tables(std::string_view key) const {
  const std::string right = fmt::format("one or more tables [[{}]]", dotted(key));
  const toml::array& array = required_array(key, right);
  if (array.empty()) fail(key, fmt::format("empty, got [], must be {}", right));
  std::vector<TableReader> readers;
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!array[i].is_table()) {
      fail_element(key, i, fmt::format("wrong type, got {}, must be a table", describe(array[i])));
    }
    readers.emplace_back(*array[i].as_table(), fmt::format("{}.{}", dotted(key), i), *source_,
                         description_of(key), errors_);
  }
  return readers;
}

void TableReader::fail(std::string_view key, const std::string& problem) const {
  throw_scene_error(head(key), problem);
}

void TableReader::fail_element(std::string_view key, std::size_t index,
                               const std::string& problem) const {
  const toml::array* array = table_->get_as<toml::array>(key);
  if (array == nullptr) fail(key, problem);
  const std::string place = location_of((*array)[index]);
  throw_scene_error(message_head(*source_, place, fmt::format("{}.{}", dotted(key), index)),
                    problem);
}

void TableReader::warn(std::string_view key, std::string_view what) const {
  if (errors_ != nullptr) errors_->warn(fmt::format("{}{}: {}", warning_head, head(key), what));
}

void TableReader::warn(std::string_view key, const std::vector<std::string>& all) const {
  if (all.empty()) return;
  const std::size_t others = all.size() - 1;
  warn(key, others == 0 ? all[0] : fmt::format("{}, and {} more such", all[0], others));
}

std::string TableReader::head(std::string_view key) const {
  return message_head(*source_, where(key), key.empty() ? path_ : dotted(key));
}

std::string TableReader::removal_of_others(std::string_view key,
                                           const std::vector<std::string_view>& given) const {
  const std::string place = where(key);
  const auto override_path = source_->override_paths.find(place);
  const bool is_named =
      override_path != source_->override_paths.end() && override_path->second == dotted(key);
  if (!is_named) return "";
  const std::string_view parent = std::string_view(place).substr(0, place.size() - key.size());
  std::string text = "; what is not wanted is removed by";
  for (const std::string_view other : given) {
    if (other != key) text += fmt::format(" {}{}=null", parent, other);
  }
  return text;
}

std::string TableReader::dotted(std::string_view key) const {
  const std::string name = printable(key);
  return path_.empty() ? name : fmt::format("{}.{}", path_, name);
}

std::string TableReader::where(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return location_of(node != nullptr ? *node : *table_);
}

std::string TableReader::found(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr ? describe(*node) : "nothing";
}

const toml::node& TableReader::required(std::string_view key, std::string_view right) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr) {
    if (errors_ != nullptr && errors_->take_excuse(path_, key)) throw AlreadySaid();
    fail(key, fmt::format("missing, must be {}", right));
  }
  return *node;
}

const toml::array& TableReader::required_array(std::string_view key, std::string_view right) const {
  const toml::node& node = required(key, right);
  if (!node.is_array()) {
    fail(key, fmt::format("wrong type, got {}, must be {}", found(key), right));
  }
  return *node.as_array();
}

double TableReader::finite(const toml::node& node, const std::string& dotted_key,
                           std::string_view right) const {
  double value = 0;
  if (node.is_integer()) {
    value = static_cast<double>(node.as_integer()->get());
  } else if (node.is_floating_point()) {
    value = node.as_floating_point()->get();
  } else {
    throw_scene_error(message_head(*source_, location_of(node), dotted_key),
                      fmt::format("wrong type, got {}, must be {}", describe(node), right));
  }
  if (!std::isfinite(value)) {
    throw_scene_error(message_head(*source_, location_of(node), dotted_key),
                      fmt::format("not finite, got {}, must be {}", describe(node), right));
  }
  return value;
}

std::string TableReader::location_of(const toml::node& node) const {
  const auto& source = node.source();
  if (!source.begin) return location(source_->name, source_->has_lines ? 1 : 0, 1);
  return location(source.path ? *source.path : source_->name, source.begin.line,
                  source.begin.column);
}

}  // namespace hamjet::io
