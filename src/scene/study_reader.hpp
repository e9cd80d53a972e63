#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "../studies/paper/canonical_transformation.hpp"
#include "../studies/paper/energy_conservation.hpp"
#include "../studies/paper/optimal_control_study.hpp"
#include "hamjet/scene/scene_reader.hpp"

namespace hamjet::io {

/// The study that `hamjet run` performs, by the key `study` of the scene. "flow-jet", the default,
/// gives a Scene; the others are studies of the paper that have no flow jet.
using Study =
    std::variant<Scene, EnergyConservationStudy, CanonicalTransformationStudy, OptimalControlStudy>;

/// Reads a scene of any study; otherwise as read_scene, which throws Error(scene) for any study but
/// "flow-jet".
Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 SceneUnits units = SceneUnits::told);

/// read_study from a text; `file_name` is used in messages and for the study's name.
Study parse_study(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides = {}, SceneUnits units = SceneUnits::told);

/// The flow jet of a study that must have one. Otherwise throws Error(scene) that names the file.
Scene require_flow_jet(Study study, const std::string& file_name);

}  // namespace hamjet::io
