#include "scene_message.hpp"

#include <fmt/format.h>

#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view override_prefix = "--set ";

/// The longest key that is shown: it has room for the longest label and the characters around the
/// label.
constexpr std::size_t longest_shown_key = 200;

/// Whether the dotted path `outer` leads to `inner`, or equals it.
bool is_path_to(std::string_view outer, std::string_view inner) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
}

}  // namespace

std::string location(std::string_view source, std::size_t line, std::size_t column) {
  if (line == 0 || is_override_source(source)) return std::string(source);
  return fmt::format("{}:{}:{}", source, line, column);
}

bool is_override_source(std::string_view source) {
  // Options that stand for a key are words; a file of such a name has an ending.
  return source.starts_with(override_prefix) ||
         (source.starts_with("--") && source.find_first_of("./ ") == std::string_view::npos);
}

std::string override_source(std::string_view key, std::string_view option) {
  if (!option.empty()) return std::string(option);
  return fmt::format("{}{}", override_prefix, printable(key, longest_shown_key));
}

std::string message_head(const SceneSource& source, std::string_view where, std::string_view key) {
  const auto override_path = source.override_paths.find(where);
  if (override_path != source.override_paths.end()) {
    const std::string& changed = override_path->second;
    if (is_path_to(key, changed)) return std::string(where);
    if (is_path_to(changed, key)) return fmt::format("{}{}", where, key.substr(changed.size()));
  }
  return fmt::format("{}: {}", where, key);
}

void throw_scene_error(std::string_view head, std::string_view problem) {
  throw Error(ErrorKind::scene, fmt::format("{}: {}", head, problem));
}

}  // namespace hamjet::io
