#include "scene_document.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_first_definition.hpp"
#include "scene_text.hpp"

namespace hamjet::io {
namespace {

/// Each dot of an override's key may add a table, and very deep tables overflow the stack when they
/// are freed.
constexpr std::size_t longest_override_key = 1000;

/// The value that removes a key; TOML has no such value.
constexpr std::string_view removal = "null";

/// The option that made the change, as messages name it.
std::string source_of(const Override& change) { return override_source(change.key, change.option); }

/// Whether a text that was refused is valid TOML all the same: if memory runs out while the library
/// reads a number, it reports the number as invalid.
bool is_toml(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
    return true;
  } catch (const toml::parse_error&) {
    return false;
  }
}

toml::table parse_toml(std::string_view text, const std::string& source) {
  text = check_scene_text(text, source);
  try {
    return toml::parse(text, std::string_view(source));
  } catch (const toml::parse_error& error) {
    if (is_toml(text)) throw std::bad_alloc();
    const auto& begin = error.source().begin;
    std::string problem = fmt::format("not valid TOML: {}", printable(error.description(), 300));
    if (error.description().find("redefine") != std::string_view::npos) {
      const auto first = first_definition(text, begin);
      if (first) problem += ", which is already at " + location(source, first->line, first->column);
    }
    throw_scene_error(location(source, begin.line, begin.column), problem);
  }
}

[[noreturn]] void throw_usage(const Override& change, const std::string& problem) {
  throw Error(ErrorKind::usage, fmt::format("{}: {}", source_of(change), problem));
}

/// The text as a TOML string.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// A table with the single key `value`, every part of which remembers that it came from the
/// override. It is parsed, because toml++ lets only its parser set the origin of a value.
toml::table parse_value(const std::string& value_as_toml, const std::string& source) {
  return parse_toml("value = " + value_as_toml, source);
}

/// Refuses a number that does not fit, which would otherwise be taken as a string.
void refuse_number_out_of_range(const Override& change) {
  std::string_view digits = change.value;
  if (digits.starts_with('+') || digits.starts_with('-')) digits.remove_prefix(1);
  const char* const end = digits.data() + digits.size();
  double number = 0;
  const auto [rest, error] = std::from_chars(digits.data(), end, number);
  const bool is_integer = digits.find_first_not_of("0123456789") == std::string_view::npos;
  const bool is_long = is_integer && digits.size() > 18 && !digits.starts_with('0');
  if (rest != end || (error != std::errc::result_out_of_range && !is_long)) return;
  throw_scene_error(source_of(change),
                    fmt::format("out of range, got {}, must be a number that binary64 holds, from "
                                "2.2e-308 to 1.8e308 in size{}",
                                printable(change.value),
                                is_integer ? ", with a point or an exponent where it does not fit "
                                             "64 bits"
                                           : ""));
}

toml::table override_value(const Override& change) {
  const std::string source = source_of(change);
  try {
    toml::table table = parse_value(change.value, source);
    // A value with a line break could add further keys.
    if (table.size() == 1) return table;
  } catch (const Error&) {
    // The value is not TOML, hence a string.
  }
  refuse_number_out_of_range(change);
  try {
    return parse_value(toml_string(change.value), source);
  } catch (const Error&) {
    throw_usage(change, "the value is not a text, got bytes that are not UTF-8 or too many");
  }
}

/// Puts the value into the table. Moving keeps the origin that the value remembers; copying would
/// lose it.
void insert(toml::table& table, std::string_view name, toml::node& value,
            const std::string& source) {
  const toml::source_region origin{{1, 1}, {1, 1}, std::make_shared<const std::string>(source)};
  value.visit(
      [&](auto& typed) { table.insert_or_assign(toml::key(name, origin), std::move(typed)); });
}

/// The element that has this label or, if no element has, this index.
std::optional<std::size_t> element_named(const toml::array& array, std::string_view name) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    const toml::table* table = array[i].as_table();
    const auto* label = table != nullptr ? table->get_as<std::string>("label") : nullptr;
    if (label != nullptr && label->get() == name) return i;
  }
  std::size_t index = 0;
  const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool is_index = error == std::errc() && rest == name.data() + name.size();
  return is_index && index < array.size() ? std::optional(index) : std::nullopt;
}

/// An override on its way down the tables to the value that it changes.
struct Assignment {
  const Override& change;
  toml::node* value;      ///< null: the existing value is removed
  std::string path = "";  ///< path so far, with indices in place of labels
  bool is_removed_element = false;
  /// A key that was to be removed and does not exist.
  std::optional<SceneSource::AbsentKey> absent = {};

  void descend(const std::string& name) { path += path.empty() ? name : '.' + name; }
};

void assign(toml::node& place, std::string_view path, Assignment& assignment);

void assign_in_table(toml::table& table, std::string_view path, Assignment& assignment) {
  const std::string source = source_of(assignment.change);
  const std::size_t dot = path.find('.');
  const std::string_view name = path.substr(0, dot);
  if (name.empty()) {
    throw_usage(assignment.change,
                "empty name, must be names with single dots between, as in jet.order");
  }
  const bool is_there = table.contains(name);
  if (!is_there && assignment.value == nullptr) {
    assignment.absent = {source, assignment.path, std::string(name)};
    assignment.descend(printable(name));
    return;
  }
  assignment.descend(printable(name));
  if (dot != std::string_view::npos) {
    if (!is_there) insert(table, name, *parse_value("{}", source).get("value"), source);
    assign(*table.get(name), path.substr(dot + 1), assignment);
  } else if (assignment.value != nullptr) {
    insert(table, name, *assignment.value, source);
  } else {
    table.erase(name);
  }
}

/// The elements in words, as in "gauss8, midpoint or an index below 2".
std::string elements_of(const toml::array& array) {
  std::vector<std::string> labels;
  for (const toml::node& element : array) {
    const toml::table* table = element.as_table();
    const auto* label = table != nullptr ? table->get_as<std::string>("label") : nullptr;
    if (label != nullptr) labels.push_back(printable(label->get()));
  }
  const std::string listed_labels = fmt::format("{}", fmt::join(labels, ", "));
  const bool is_short = !labels.empty() && listed_labels.size() <= 200;
  return fmt::format("{} or an index below {}", is_short ? listed_labels : "a label", array.size());
}

void assign_in_array(toml::array& array, std::string_view path, Assignment& assignment) {
  // Labels may contain dots, so that the longest name that fits is taken.
  for (std::size_t end = path.size();; end = path.rfind('.', end - 1)) {
    if (end == std::string_view::npos || end == 0) break;
    const auto index = element_named(array, path.substr(0, end));
    if (!index) continue;
    assignment.descend(std::to_string(*index));
    if (end < path.size()) return assign(array[*index], path.substr(end + 1), assignment);
    const auto element = array.cbegin() + static_cast<std::ptrdiff_t>(*index);
    if (assignment.value == nullptr) {
      array.erase(element);
      assignment.is_removed_element = true;
    } else {
      assignment.value->visit([&](auto& typed) { array.replace(element, std::move(typed)); });
    }
    return;
  }
  throw_usage(assignment.change,
              fmt::format("no such element, got {}, must be {}",
                          in_quotes(path.substr(0, path.find('.'))), elements_of(array)));
}

/// Continues at `place` to the end of `path`, the rest of the override's key.
void assign(toml::node& place, std::string_view path, Assignment& assignment) {
  if (toml::table* table = place.as_table()) {
    assign_in_table(*table, path, assignment);
  } else if (toml::array* array = place.as_array()) {
    assign_in_array(*array, path, assignment);
  } else {
    throw_usage(assignment.change, fmt::format("no such key, got {} below a value, must be a key "
                                               "of a table",
                                               in_quotes(path)));
  }
}

/// An override that has been applied.
struct Applied {
  const Override* change;
  std::string path;  ///< path with indices in place of labels
  bool is_removed_element = false;
};

/// Refuses a second value for one key, or a value for a table or an array after a value for one of
/// its keys: the first value would be lost silently.
void refuse_second_value(const std::vector<Applied>& earlier, const Applied& last) {
  const auto first = std::find_if(earlier.begin(), earlier.end(), [&](const Applied& other) {
    return other.path == last.path || other.path.starts_with(last.path + '.');
  });
  if (first == earlier.end()) return;
  const std::string name = source_of(*first->change);
  if (first->path != last.path) {
    throw_usage(*last.change,
                fmt::format("replaces what {} has given; must stand before it", name));
  }
  if (first->change->key != last.change->key || name != source_of(*last.change)) {
    throw_usage(*last.change, fmt::format("the same key as {}; must be given once", name));
  }
  throw_usage(*last.change,
              fmt::format("given twice, as {} and as {}; must be given once",
                          printable(first->change->value), printable(last.change->value)));
}

/// A removed key may be given again, and the elements after a removed element move up.
void forget_removed(std::vector<Applied>& earlier, const Applied& removed) {
  std::erase_if(earlier, [&](const Applied& one) {
    return one.path == removed.path || one.path.starts_with(removed.path + '.');
  });
  if (!removed.is_removed_element) return;
  const std::size_t at = removed.path.rfind('.') + 1;
  const std::string array = removed.path.substr(0, at);
  for (Applied& one : earlier) {
    if (!one.path.starts_with(array)) continue;
    std::size_t index = 0;
    const char* const digits = one.path.data() + at;
    const auto end = std::from_chars(digits, one.path.data() + one.path.size(), index).ptr;
    if (index > std::stoul(removed.path.substr(at))) {
      one.path.replace(at, static_cast<std::size_t>(end - digits), std::to_string(index - 1));
    }
  }
}

Applied apply(const Override& change, SceneDocument& document) {
  if (change.key.size() > longest_override_key) {
    throw_usage(change, fmt::format("the key is too long, got {} bytes, must be at most {}",
                                    change.key.size(), longest_override_key));
  }
  // An empty value comes from an unset variable of a script, and must be an error.
  if (change.value.empty()) {
    throw_usage(change, "empty, must be a value (null removes the key, \"\" is the empty string)");
  }
  toml::table value;
  if (change.value != removal) value = override_value(change);
  Assignment assignment{change, value.get("value")};
  assign(document.table, change.key, assignment);
  if (assignment.absent) {
    // What an option removes beside the key that it stands for need not be there.
    if (change.option.empty()) document.source.absent_keys.push_back(*assignment.absent);
  } else {
    document.source.override_paths.insert_or_assign(source_of(change), assignment.path);
  }
  return {&change, assignment.path, assignment.is_removed_element};
}

/// Writes out what the document implies where an override names a key in it.
void write_implied(std::string_view implied, const std::vector<Override>& overrides,
                   SceneDocument& document) {
  if (implied.empty() || overrides.empty()) return;
  toml::table tables = parse_toml(implied, "the default");
  for (const Override& change : overrides) {
    const std::size_t dot = change.key.find('.');
    const std::string_view name = std::string_view(change.key).substr(0, dot);
    if (dot == std::string::npos || document.table.contains(name) || !tables.contains(name)) {
      continue;
    }
    insert(document.table, name, *tables.get(name), "the default");
  }
}

void apply(const std::vector<Override>& overrides, std::string_view implied,
           SceneDocument& document) {
  write_implied(implied, overrides, document);
  std::vector<Applied> earlier;
  for (const Override& change : overrides) {
    Applied last = apply(change, document);
    if (change.value == removal) {
      forget_removed(earlier, last);
    } else {
      refuse_second_value(earlier, last);
      earlier.push_back(std::move(last));
    }
  }
}

}  // namespace

SceneDocument parse_document(std::string_view text, const std::string& name,
                             const std::vector<Override>& overrides, std::string_view implied) {
  SceneDocument document{parse_toml(text, name), {name, true, {}}};
  apply(overrides, implied, document);
  return document;
}

SceneDocument make_document(toml::table tables, const std::string& name,
                            const std::vector<Override>& overrides, std::string_view implied) {
  SceneDocument document{std::move(tables), {name, false, {}}};
  apply(overrides, implied, document);
  return document;
}

}  // namespace hamjet::io
