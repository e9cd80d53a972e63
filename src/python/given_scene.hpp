#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../scene/study_reader.hpp"

namespace hamjet::python {

/// A scene that was read, with its file's name for messages.
struct GivenScene {
  /// Reads by a function of the units; in the chief's own too where the scene asks for others.
  template <class Read>
  GivenScene(const Read& read, std::string name)
      : study(read(io::SceneUnits::told)), file(std::move(name)) {
    const Scene* const told = std::get_if<Scene>(&study);
    if (told != nullptr && told->told_units) in_chiefs_units = read(io::SceneUnits::chiefs);
  }

  io::Study study;
  std::optional<io::Study> in_chiefs_units;  ///< absent: as `study`
  std::string file;

  bool is_flow_jet() const { return std::holds_alternative<Scene>(study); }
  /// What is almost surely a slip, a line each.
  std::vector<std::string> warnings() const {
    const Scene* scene = std::get_if<Scene>(&study);
    return scene != nullptr ? scene->warnings : std::vector<std::string>{};
  }
  /// In the chief's own units unless others are said. Throws Error(scene) if it is a study without
  /// a flow jet.
  Scene flow_jet(io::SceneUnits units = io::SceneUnits::chiefs) const {
    const bool is_chiefs = units == io::SceneUnits::chiefs && in_chiefs_units;
    return io::require_flow_jet(is_chiefs ? *in_chiefs_units : study, file);
  }
};

}  // namespace hamjet::python
