#pragma once

#include <string>

#include "../scene/study_reader.hpp"

namespace hamjet::python {

/// A scene that was read, with its file's name for messages.
struct GivenScene {
  io::Study study;
  std::string file;

  bool is_flow_jet() const { return std::holds_alternative<Scene>(study); }
  /// Throws Error(scene) if it is a study without a flow jet.
  Scene flow_jet() const { return io::require_flow_jet(study, file); }
};

}  // namespace hamjet::python
