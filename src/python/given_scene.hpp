#pragma once

#include <string>
#include <vector>

#include "../scene/study_reader.hpp"

namespace hamjet::python {

/// A scene that was read, with its file's name for messages.
struct GivenScene {
  io::Study study;
  std::string file;

  bool is_flow_jet() const { return std::holds_alternative<Scene>(study); }
  /// What is almost surely a slip, a line each.
  std::vector<std::string> warnings() const {
    const Scene* scene = std::get_if<Scene>(&study);
    return scene != nullptr ? scene->warnings : std::vector<std::string>{};
  }
  /// Throws Error(scene) if it is a study without a flow jet.
  Scene flow_jet() const { return io::require_flow_jet(study, file); }
};

}  // namespace hamjet::python
