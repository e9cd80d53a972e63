#pragma once

#include <string_view>
#include <vector>

#include "scene_sections.hpp"

namespace hamjet::io {

/// A table of a flow jet's scene that one study alone works on, and that is read when the orbit,
/// the jet and the integrators have been.
struct TableOfStudy {
  std::string_view name = {};
  const TableDescription& (*description)() = nullptr;
  std::string_view absence = {};  ///< what holds without the table, for the page of keys
  std::string_view help = {};
  /// Sets the scene's member. Throws Error(scene) as every reader of a table.
  void (*read)(const TableReader& table, Scene& scene, const Nominal& nominal) = nullptr;
};

// Each is defined in the file of its table, with its declaration and its reader.

TableOfStudy bounded_of_scenes();
TableOfStudy eval_of_scenes();
TableOfStudy event_of_scenes();
TableOfStudy periodic_of_scenes();

/// All of them, in the order in which messages list them.
inline std::vector<TableOfStudy> tables_of_studies() {
  return {eval_of_scenes(), bounded_of_scenes(), event_of_scenes(), periodic_of_scenes()};
}

}  // namespace hamjet::io
