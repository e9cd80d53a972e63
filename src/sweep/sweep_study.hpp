#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"

namespace hamjet::io {

/// The commands that the items of a sweep may be: `run` and those of all studies, without files and
/// plots.
const std::vector<std::string_view>& sweep_commands();

/// A key of the scene that differs from item to item.
struct SweepKey {
  std::string name;  ///< as --set takes it, for example "nominal.e"
  bool is_logarithmic = false;
  std::string place = "";  ///< where the study gives it, for messages: `file:line:column: key`
};

/// A column of the table: a number, text or truth value of the item's summary.
struct SweepColumn {
  std::string name;
  std::string unit;        ///< may be empty
  std::string pointer;     ///< in summary.json (RFC 6901)
  std::string place = "";  ///< where the study gives it, for messages
};

/// What is drawn: a column over two keys.
struct SweepMap {
  std::size_t x = 0;      ///< index of a key
  std::size_t y = 0;      ///< index of a key
  std::size_t value = 0;  ///< index of a column
  bool is_logarithmic = false;
};

/// A scene, many times, with other values of some keys. All but the places and `scene_path` is
/// frozen in the manifest (see `sweep_manifest`).
struct SweepStudy {
  std::string name;  ///< name of the file, fit for a directory
  std::string title;
  std::string version;  ///< version of the hamjet that made it
  std::string command = "run";
  std::string scene;                 ///< the base scene's file, as the study names it
  std::string scene_text;            ///< content of the scene's file
  std::filesystem::path scene_path;  ///< where it is; empty in a study that a manifest gave
  std::vector<Override> constants;   ///< changes that all items share
  std::vector<std::string> constant_places;
  bool is_grid = false;  ///< the items are all combinations of the keys' values
  std::vector<SweepKey> keys;
  /// For each item one value a key, as --set takes it; empty: the item leaves the key alone.
  std::vector<std::vector<std::string>> items;
  std::vector<SweepColumn> columns;
  std::optional<SweepMap> map;
};

/// The most items that a sweep may have.
inline constexpr std::size_t most_sweep_items = 1'000'000;

/// Reads a study and its base scene. Throws Error(input_output) if one of them cannot be read,
/// Error(scene) with `file:line:column: key: ...` for a mistake, Error(too_large) for more than
/// `most_sweep_items`. The scenes of the items are not read (see `check_sweep_items`).
SweepStudy read_sweep_study(const std::filesystem::path& file);

/// read_sweep_study from text; `file` names the study, and `read_scene` brings the text of the base
/// scene, for example from memory. Studies of more than `most_items` items are refused.
SweepStudy parse_sweep_study(
    std::string_view text, const std::filesystem::path& file,
    const std::function<std::string(const std::filesystem::path&)>& read_scene,
    std::size_t most_items = most_sweep_items);

/// The changes of one item, in the order in which they are applied.
std::vector<Override> sweep_overrides(const SweepStudy& study, std::size_t item);

/// A value as a table shows it: a string without its quotes.
std::string shown_sweep_value(const std::string& value);

/// The keys of one item with their values: "nominal.e = 0.1, nominal.i_deg = 30".
std::string sweep_item_text(const SweepStudy& study, std::size_t item);

/// The study as one JSON object that ends with the CRC-32 of itself: equal texts mean equal sweeps.
std::string sweep_manifest(const SweepStudy& study);

/// The study that a manifest holds. Throws Error(input_output) with `file` if the text is not,
/// byte by byte, a manifest of this version of the format.
SweepStudy parse_sweep_manifest(const std::string& text, const std::string& file);

}  // namespace hamjet::io
