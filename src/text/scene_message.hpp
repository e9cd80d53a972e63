#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "printable_text.hpp"

namespace hamjet::io {

/// The candidate nearest to a misspelt `name`: by an edit distance that counts a swap of neighbours
/// as one, or because only the unit is missing in `name`. No value if none is near. A name that
/// differs in a digit, or in a symbol of one or two letters, means another quantity and is never
/// near.
std::optional<std::string_view> nearest(std::string_view name,
                                        const std::vector<std::string_view>& candidates);

/// Names in one text, each printable: "a, b, c". A list of more than 40 names is cut off and says
/// how many more there are.
std::string listed(const std::vector<std::string_view>& names);

/// The suggestion at the end of a message: the nearest of `candidates`, or the list of all.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

/// What to write in place of a key that this table does not have, but that scenes of other programs
/// do; no value for any other key.
std::optional<std::string_view> remedy_for_foreign_key(std::string_view table,
                                                       std::string_view name);

/// Where a value stands, as messages write it: `source:line:column`. It is `source` alone for a
/// command-line override, which has no lines (see `override_source`), and for line 0, which stands
/// for tables without a text.
std::string location(std::string_view source, std::size_t line, std::size_t column);

/// The source name of values that come from `--set key=value`: the option with the key as written,
/// or the option that stands for this key, such as `--coordinates`.
std::string override_source(std::string_view key, std::string_view option = {});
/// Whether a message begins with such an option, which has no lines.
bool is_override_source(std::string_view source);

/// Where the values of a scene come from.
struct SceneSource {
  std::string name;       ///< printable name of the file
  bool has_lines = true;  ///< false for tables that a program has made
  /// For each override, by its source name: the path of what it changed, with indices in place of
  /// labels.
  std::map<std::string, std::string, std::less<>> override_paths;
  std::filesystem::path folder = {};  ///< folder to which file names in the scene are relative
  /// A key that an override removes although the scene does not have it. This is no mistake if the
  /// table may have the key.
  struct AbsentKey {
    std::string override_name;  ///< see `override_source`
    std::string table;          ///< path, with indices in place of labels
    std::string name;
  };
  std::vector<AbsentKey> absent_keys = {};
};

/// The head of a message about the value of `key` at `where` (see `location`). It is `where: key`.
/// For an override it is the option with the key as the user wrote it, extended by the path below
/// that key: `--set reference.tol` for a mistake in `--set reference={tol=1}`.
std::string message_head(const SceneSource& source, std::string_view where, std::string_view key);

/// How a line begins that warns about a scene that is accepted.
inline constexpr std::string_view warning_head = "warning: ";
/// How a line begins that informs about a scene that is accepted.
inline constexpr std::string_view note_head = "note: ";

/// Throws Error(scene) with the message `head: problem`.
[[noreturn]] void throw_scene_error(std::string_view head, std::string_view problem);

}  // namespace hamjet::io
