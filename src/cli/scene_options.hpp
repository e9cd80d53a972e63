#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "../scene/study_reader.hpp"
#include "../studies/skipped_work.hpp"

namespace hamjet::cli {

/// Options of the commands that take a scene.
struct RunOptions {
  std::optional<std::string> scene_file;  ///< absent: the built-in scene
  std::optional<std::string> scene_text;  ///< the text of standard input; scene_file is its name
  std::optional<std::string> output;
  std::vector<std::string> overrides;    ///< key=value
  std::vector<io::Override> of_options;  ///< keys that options of their own set, behind these
  bool json = false;
  bool quiet = false;
  bool has_time = false;  ///< for check: whether to measure how long each command would take
  bool verbose = false;
  std::size_t threads = 0;  ///< number of threads for arcs; 0: as many as the machine runs at once
  std::string command;      ///< the command line, for reports
};

/// Where the scene file is `-`, reads standard input, which can be done once, and gives it a name.
/// Throws Error(input_output), and Error(scene) for more than any scene has.
void take_standard_input(RunOptions& options);

/// The scene that the options name, with their changes, of any study, in the units that it asks
/// for. Throws Error(usage), Error(scene), Error(input_output).
io::Study read_study(const RunOptions& options, io::SceneUnits units = io::SceneUnits::told);

/// The scene that the options name, which must be that of a flow jet, in the chief's own units
/// unless others are said. Throws Error(usage), Error(scene), Error(input_output).
Scene read_scene(const RunOptions& options, io::SceneUnits units = io::SceneUnits::chiefs);

/// read_scene for `command`, which does not split flows into arcs: throws Error(scene) too where
/// the scene asks for that.
Scene read_unsplit_scene(const RunOptions& options, const std::string& command,
                         io::SceneUnits units = io::SceneUnits::chiefs);

/// Says likewise what is to be said of flow boxes near escape.
void note_escape(const RunOptions& options, const Scene& scene);

/// Says on standard error, unless that is to be quiet, what a command does not take of the scene,
/// if there is such.
void note_unused(const RunOptions& options, const std::optional<SkippedWork>& unused);

/// The number of threads that the options ask for, at least 1.
std::size_t thread_count(const RunOptions& options);

/// Where the results go: as asked for, or `out/<scene name>`.
std::filesystem::path output_path(const RunOptions& options, const std::string& scene_name);

}  // namespace hamjet::cli
