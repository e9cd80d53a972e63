#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// One `--set key=value`. The key is a dotted path; an element of an array is named by its index
/// from 0 or, if it is a table with a label, by its label: `jet.order`, `integrator.0.tolerance`,
/// `integrator.gauss8.tolerance`. Missing tables on the way are added. The value is TOML (`3`, `[1,
/// 2]`, `{}`); a value that is not valid TOML is taken as a string. The value `null`, which TOML
/// does not know, removes the key or the element, which must be there; an empty value is an error.
/// To change from one of several forms of a table to another, remove the keys of the old form
/// (`jet.duration_canonical=null`) or give the whole table: `nominal={a_km=7000, ...}`.
struct Override {
  std::string key;
  std::string value;
  /// The option of the command that stands for this key, which messages name: `--coordinates`;
  /// empty: `--set key`.
  std::string option = {};
};

/// The canonical units in which the numbers of a scene about an orbit are read.
enum class SceneUnits {
  told,   ///< units of the scene's table `[units]`: the coefficients of a run are in them, to every
          ///< digit
  chiefs  ///< the chief's own units, whatever the table says: no result of a computation depends on
          ///< the table
};

/// Reads a scene file and applies the overrides in their order. After this the same rules hold as
/// if the file had been written in this way. Throws
///  - Error(input_output) with the path and the reason if the file cannot be read, or is a
///    directory, a pipe or a device; and for a gravity file that the scene names, relative to its
///    own folder (see gravity_field_file.hpp);
///  - Error(scene) with `file:line:column: key: what is wrong, got what, what would be right`, a
///    line for each mistake, in the order of the lines, and of more than 20 how many more; for a
///    value that an override gave, `--set key` stands in place of location and key. A text that is
///    too large or not UTF-8 is named by its size or the byte's offset;
///  - Error(too_large) for an order above 20, or more than 1e9 fixed steps, where nothing else is
///    wrong;
///  - Error(usage) for an override whose key leads nowhere or whose value is empty, or that
///    takes away what an earlier one gave.
///
/// A fixed step that is longer than the duration means a single step.
///
/// `hamjet run` and `compare` read a scene in the units that it asks for. All other commands take
/// SceneUnits::chiefs, in which two scenes that differ in the table `[units]` alone have the same
/// numbers bit by bit, but for what they give in canonical units; see Scene::told_units.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 SceneUnits units = SceneUnits::told);

/// read_scene from a text. `file_name` is used in messages and for Scene::name. Every number
/// becomes the nearest binary64; the conversion to canonical units is done in extended precision
/// and rounded once.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides = {}, SceneUnits units = SceneUnits::told);

}  // namespace hamjet::io
