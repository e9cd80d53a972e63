#include "scene_first_definition.hpp"

#include <cstddef>
#include <string>

namespace hamjet::io {
namespace {

/// A key that no scene has. At the end of a text it shows which table is open there.
constexpr std::string_view probe = "\x01";
constexpr std::string_view probe_line = "\n\"\\u0001\" = 0\n";

/// Byte offset of a line, counted from 1.
std::size_t start_of_line(std::string_view text, std::size_t line) {
  std::size_t offset = 0;
  for (std::size_t i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', offset);
    if (end == std::string_view::npos) return text.size();
    offset = end + 1;
  }
  return offset;
}

/// The first characters of a line, which may take more bytes.
std::string_view first_characters(std::string_view line, std::size_t count) {
  std::size_t bytes = 0;
  for (; bytes < line.size(); ++bytes) {
    const bool begins_character = (static_cast<unsigned char>(line[bytes]) & 0xc0U) != 0x80U;
    if (begins_character && count-- == 0) break;
  }
  return line.substr(0, bytes);
}

const toml::table* table_with_probe(const toml::node& node) {
  if (const toml::table* table = node.as_table()) {
    if (table->contains(probe)) return table;
    for (const auto& [key, value] : *table) {
      if (const toml::table* found = table_with_probe(value)) return found;
    }
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) {
      if (const toml::table* found = table_with_probe(element)) return found;
    }
  }
  return nullptr;
}

/// The table to which the next header adds: the node itself, or the last table of an array of
/// tables.
const toml::table* table_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array != nullptr && !array->empty()) return array->back().as_table();
  return node.as_table();
}

/// The place where the table already has a value at the path of `statement`, a single dotted key.
std::optional<toml::source_position> find_in(const toml::table* table,
                                             const toml::table& statement) {
  const toml::table* path = &statement;
  while (table != nullptr && path != nullptr && path->size() == 1) {
    const toml::table::const_iterator entry = path->cbegin();
    const toml::node* node = table->get(entry->first.str());
    if (node == nullptr) return std::nullopt;
    const toml::table* rest = entry->second.as_table();
    if (rest == nullptr || rest->empty() || !(node->is_table() || node->is_array())) {
      return node->source().begin;
    }
    table = table_of(*node);
    path = rest;
  }
  return std::nullopt;
}

}  // namespace

std::optional<toml::source_position> first_definition(std::string_view text,
                                                      const toml::source_position& second) {
  const std::size_t start = start_of_line(text, second.line);
  const std::string before(text.substr(0, start));
  const std::string_view rest = text.substr(start);
  const std::string_view line = rest.substr(0, rest.find('\n'));
  const std::size_t first = line.find_first_not_of(" \t");
  const bool is_header = first != std::string_view::npos && line[first] == '[';
  try {
    if (is_header) {
      const toml::table above = toml::parse(before);
      return find_in(&above, toml::parse(line));
    }
    // The error is at the value, so that the key and the equals sign stand before it.
    const toml::table above = toml::parse(before + std::string(probe_line));
    const std::string key(first_characters(line, second.column - 1));
    return find_in(table_with_probe(above), toml::parse(key + "0"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace hamjet::io
