#include "scene_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <variant>
#include <vector>

#include "../app/processors.hpp"
#include "../app/refusal.hpp"
#include "../scene/document/scene_text.hpp"
#include "../scene/scene_name.hpp"
#include "../studies/arcs.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../studies/formation/charts/deputy_flows.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "../text/scene_refusal.hpp"
#include "demo_scene.hpp"
#include "hamjet/error.hpp"
#include "process/standard_streams.hpp"

namespace hamjet::cli {
namespace {

std::vector<io::Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<io::Override> overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(
          ErrorKind::usage,
          fmt::format("--set {}: must be key=value, for example jet.order=3", io::printable(text)));
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

/// The built-in scene names CVODE; a build without it shows the rest. A scene of the user's own is
/// refused instead: what it asks for must not vanish.
void leave_out_what_is_not_built(Scene& scene) {
  const auto removed = std::erase_if(scene.integrators, [](const IntegratorSettings& settings) {
    return !description_of(settings.method).is_built();
  });
  if (removed > 0) {
    print_error(
        fmt::format("this build has no CVODE; left out: {} of the scene", counted(removed, "run")));
  }
}

}  // namespace

void take_standard_input(RunOptions& options) {
  if (options.scene_file != "-") return;
  options.scene_file = io::standard_input_name;
  options.scene_text = read_standard_input(io::largest_scene_bytes);
}

io::Study read_study(const RunOptions& options, io::SceneUnits units) {
  refuse_empty(options.scene_file, "scene", "a file");
  refuse_empty(options.output, "--output", "a directory");
  auto overrides = parse_overrides(options.overrides);
  overrides.insert(overrides.end(), options.of_options.begin(), options.of_options.end());
  if (options.scene_file) {
    io::Study study = options.scene_text ? io::parse_study(*options.scene_text, *options.scene_file,
                                                           overrides, units)
                                         : io::read_study(*options.scene_file, overrides, units);
    if (const Scene* scene = std::get_if<Scene>(&study)) {
      for (const std::string& warning : scene->warnings) print_error(warning);
    }
    return study;
  }
  Scene scene = io::parse_scene(demo_scene, "earth-orbit.toml", overrides, units);
  leave_out_what_is_not_built(scene);
  return scene;
}

Scene read_scene(const RunOptions& options, io::SceneUnits units) {
  // The built-in scene is a flow jet.
  return io::require_flow_jet(read_study(options, units), options.scene_file.value_or(""));
}

Scene read_unsplit_scene(const RunOptions& options, const std::string& command,
                         io::SceneUnits units) {
  Scene scene = read_scene(options, units);
  io::naming_file(options.scene_file.value_or(""), [&] { require_unsplit(scene, command); });
  return scene;
}

void note_escape(const RunOptions& options, const Scene& scene) {
  if (options.quiet) return;
  if (const auto note = escape_note(scene)) print_error("note: " + *note);
}

void note_unused(const RunOptions& options, const std::optional<SkippedWork>& unused) {
  if (!unused || options.quiet) return;
  print_error(fmt::format("note: {} are not used: {}", unused->what, unused->why));
}

std::size_t thread_count(const RunOptions& options) {
  if (options.threads > 0) return options.threads;
  return usable_processors();
}

std::filesystem::path output_path(const RunOptions& options, const std::string& scene_name) {
  return options.output ? std::filesystem::path(*options.output)
                        : std::filesystem::path("out") / scene_name;
}

}  // namespace hamjet::cli
