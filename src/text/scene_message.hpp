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

/// The candidate nearest to a misspelt `name` (an edit distance that counts a swap of neighbours as
/// one, or a name whose unit was left off), or nothing if none is near. What differs in a digit, or
/// in a symbol of one or two letters, is another quantity and never near.
std::optional<std::string_view> nearest(std::string_view name,
                                        const std::vector<std::string_view>& candidates);

/// Names in one text, each printable: "a, b, c". Of more than 40 it says how many more there are.
std::string listed(const std::vector<std::string_view>& names);

/// Says what was meant: the nearest of `candidates`, or the list of all.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

/// What to give in place of a key that scenes do not have in this table, but those of other
/// programs do; no value for any other key.
std::optional<std::string_view> remedy_for_foreign_key(std::string_view table,
                                                       std::string_view name);

/// Where a value stands: `source:line:column`, or `source` alone for a command-line override, which
/// has no lines (see `override_source`), and for line 0, which stands for tables without a text.
std::string location(std::string_view source, std::size_t line, std::size_t column);

/// The source name of values that come from `--set key=value`: the option with the key as written.
std::string override_source(std::string_view key);

/// Where the values of a scene come from.
struct SceneSource {
  std::string name;       ///< of the file, printable
  bool has_lines = true;  ///< false: tables that a program has made
  /// What each override changed: its source name, and the path with indices in place of labels.
  std::map<std::string, std::string, std::less<>> override_paths;
  std::filesystem::path folder = {};  ///< what files that the scene names are relative to
  /// A key that an override removes though it is not there: no mistake if the table may have it.
  struct AbsentKey {
    std::string override_name;  ///< see `override_source`
    std::string table;          ///< path, with indices in place of labels
    std::string name;
  };
  std::vector<AbsentKey> absent_keys = {};
};

/// The head of a message about the value of `key` at `where` (see `location`): `where: key`, but
/// for an override the option and the key once, as the user wrote them, with what lies below:
/// `--set reference.tol` for a mistake in `--set reference={tol=1}`.
std::string message_head(const SceneSource& source, std::string_view where, std::string_view key);

/// What a line begins with that warns of a scene and does not refuse it.
inline constexpr std::string_view warning_head = "warning: ";
/// And one that says what a person may want to know.
inline constexpr std::string_view note_head = "note: ";

/// Throws Error(scene) with the message `head: problem`.
[[noreturn]] void throw_scene_error(std::string_view head, std::string_view problem);

}  // namespace hamjet::io
