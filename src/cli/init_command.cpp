#include "init_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>
#include <vector>

#include "../app/refusal.hpp"
#include "../dynamics/celestial_bodies.hpp"
#include "../formats/orbit_messages/known_text.hpp"
#include "../report/propagation/orbit_summary.hpp"
#include "../scene/scene_name.hpp"
#include "../scene/study_reader.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/shell_text.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "output_file.hpp"
#include "output_option.hpp"
#include "process/standard_streams.hpp"
#include "scene_options.hpp"
#include "scene_templates.hpp"

namespace hamjet::cli {
namespace {

namespace fs = std::filesystem;

/// Templates of this beginning are filled in from an orbit message; the others are the kinds.
constexpr std::string_view message_template = "message";
constexpr std::string_view message_template_of_other_centres = "message-other-centre";

/// Lines of a template with this beginning are commands to go on with.
constexpr std::string_view command_line = "#   hamjet ";

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const auto& [name, text] : scene_templates) {
    if (!name.starts_with(message_template)) names.emplace_back(name);
  }
  return names;
}

/// What stands in place of the marks of a template, each between two signs @.
using Filling = std::map<std::string, std::string>;

std::string filled(std::string_view name, const Filling& filling) {
  const auto* const found =
      std::find_if(std::begin(scene_templates), std::end(scene_templates),
                   [&](const auto& candidate) { return candidate.first == name; });
  // In one pass over the template: what was filled in may look like a mark itself.
  std::string_view left(found->second);
  std::string text;
  while (!left.empty()) {
    const auto mark = std::find_if(filling.begin(), filling.end(), [&](const auto& entry) {
      return left.starts_with("@" + entry.first + "@");
    });
    if (mark != filling.end()) {
      text += mark->second;
      left.remove_prefix(mark->first.size() + 2);
    } else {
      text += left.front();
      left.remove_prefix(1);
    }
  }
  return text;
}

/// A string of TOML, whose escapes are those of JSON.
std::string toml_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// What a scene takes from an orbit message, and how the scene names that.
struct MessageStart {
  io::OrbitMetadata metadata;
  std::optional<double> mu_km3_s2;
  std::string file_key;
  bool is_one_of_several = false;
};

MessageStart read_message(const fs::path& file) {
  const std::string name = io::printable_path(file);
  const std::string text = io::require_regular_file(file, io::largest_orbit_message_bytes);
  // The scene is about the real Earth, whose own axes are known.
  constexpr auto frames = io::AcceptedFrames::terrestrial_too;
  if (text.find("CCSDS_OEM_VERS") != std::string::npos) {
    const io::OrbitEphemerisMessage message = io::read_oem(name, text, frames);
    const io::OrbitMetadata& first = message.segments.front().metadata;
    const bool is_one_of_several = std::any_of(
        message.segments.begin(), message.segments.end(), [&](const io::EphemerisSegment& other) {
          return other.metadata.object_id != first.object_id ||
                 other.metadata.object_name != first.object_name;
        });
    return {first, std::nullopt, "oem_file", is_one_of_several};
  }
  if (text.find("CCSDS_OPM_VERS") != std::string::npos) {
    const io::OrbitParameterMessage message = io::read_opm(name, text, frames);
    return {message.metadata, message.gm_km3_s2, "opm_file", false};
  }
  const io::KnownText* const other = io::known_text(text);
  throw Error(ErrorKind::input_output,
              fmt::format("{}: is no orbit message{}, must begin with CCSDS_OEM_VERS or "
                          "CCSDS_OPM_VERS",
                          name,
                          other != nullptr ? fmt::format(", got {}, {}", other->name, other->use)
                                           : std::string()));
}

/// The path of a file as a scene beside `scene` names it.
fs::path path_beside(const fs::path& file, const fs::path& scene) {
  if (file.is_absolute()) return file;
  const auto folder_of = [](const fs::path& path) {
    return fs::weakly_canonical(path.has_parent_path() ? path.parent_path() : ".");
  };
  return (folder_of(file).lexically_relative(folder_of(scene)) / file.filename())
      .lexically_normal();
}

/// Fills in what follows from the message; returns the name of the template that fits its centre.
std::string_view fill_from_message(const fs::path& file, const fs::path& scene, Filling& filling) {
  const MessageStart start = read_message(file);
  const CelestialBody* const body = body_named(start.metadata.center_name);
  if (body == nullptr && !start.mu_km3_s2) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}:{}: CENTER_NAME: {} has no mu that is known here; `hamjet init "
                            "leo` writes a scene in which system and nominal can be replaced",
                            io::printable_path(file), start.metadata.center_name_line,
                            io::printable(start.metadata.center_name)));
  }
  filling["title"] = toml_string(start.metadata.object_name);
  filling["nominal"] =
      fmt::format("{} = {}", start.file_key, toml_string(path_beside(file, scene).string()));
  if (start.is_one_of_several) {
    filling["nominal"] += fmt::format("\nobject = {}  # the first of several in the file",
                                      toml_string(start.metadata.object_id));
  }
  if (body != nullptr && body->name == "EARTH") return message_template;
  filling["mu"] = fmt::format("{}", start.mu_km3_s2 ? *start.mu_km3_s2 : body->mu_km3_s2);
  return message_template_of_other_centres;
}

void check_options(const InitOptions& options) {
  refuse_empty(options.message, "--from", "an orbit message");
  refuse_empty(options.output, "--output", "a file");
  if (options.kind.has_value() == options.message.has_value()) {
    refuse(fmt::format("init: got {}, must be one of a kind ({}) and --from with an orbit message",
                       options.kind ? "a kind and --from" : "neither a kind nor --from",
                       fmt::join(kind_names(), ", ")));
  }
  // The name stands in a comment of the scene.
  if (options.output && io::printable(*options.output, std::string::npos) != *options.output) {
    refuse(fmt::format("--output: got {}, must be a name of printable characters",
                       io::in_quotes(*options.output)));
  }
}

/// Fills in a duration: a revolution, or an hour where the orbit has none.
void fill_duration(bool has_period, Filling& filling) {
  filling["span"] = has_period ? "one revolution" : "an hour";
  filling["duration"] =
      has_period ? "duration_orbits = 1        # periods of the start's ellipse; or duration_s"
                 : "duration_s = 3600          # the start is on no ellipse, and has no period";
}

/// The study that the scene is, which must read: what a message says may make one that does not,
/// and nobody should get that.
io::Study study_of(const std::string& scene, const fs::path& file,
                   const std::optional<std::string>& message) {
  try {
    return io::parse_study(scene, file.string());
  } catch (const Error& error) {
    if (!message) throw;
    throw Error(error.kind(), fmt::format("{}: makes no scene that can be run: {}",
                                          io::printable_path(*message), error.what()));
  }
}

/// Whether the orbit of the scene's start is closed.
bool has_period(const io::Study& study) {
  const auto* scene = std::get_if<Scene>(&study);
  const auto orbit = scene != nullptr ? io::orbit_summary(*scene) : std::nullopt;
  return orbit && orbit->period_s;
}

/// The commands that the scene's first comment names, a line each, of the program as it was called.
std::string commands_in(std::string_view scene, const std::string& program) {
  std::string commands;
  while (!scene.empty()) {
    const std::string_view line = io::take_line(scene);
    if (line.starts_with(command_line)) {
      commands += fmt::format("  {} {}\n", program, line.substr(command_line.size()));
    }
  }
  return commands;
}

}  // namespace

CLI::App* add_init_command(CLI::App& app, InitOptions& options) {
  CLI::App* command =
      app.add_subcommand("init",
                         "write a commented scene that runs as it is, to start from\n"
                         "Example: hamjet init leo");
  command
      ->add_option("kind", options.kind,
                   "an orbit that is low, geostationary, a transfer between the two, or Molniya's; "
                   "a pair of satellites with a transfer; or equations of your own")
      ->check(CLI::IsMember(kind_names()));
  command
      ->add_option("--from", options.message,
                   "in place of a kind: orbit message of CCSDS (OEM or OPM) with the start, which "
                   "the scene names; about the Earth or another body of the Solar System")
      ->type_name("FILE");
  add_output_option(*command, options.output,
                    "file to write, where none is yet (default: the kind, or the message's name, "
                    "with .toml in the current folder)",
                    "FILE", "but a scene is a file");
  return command;
}

int init(const InitOptions& options) {
  check_options(options);
  const std::string name = options.kind ? *options.kind : io::scene_name(*options.message);
  const fs::path file = options.output ? fs::path(*options.output) : fs::path(name + ".toml");
  const std::string file_text = io::printable_path(file);
  OutputFile output(file, Existing::kept);
  const fs::path results = output_path({}, io::scene_name(file.string()));
  Filling filling = {{"scene", io::in_shell_quotes(file.string())},
                     {"results", io::in_shell_quotes(results.string())}};
  const std::string_view chosen =
      options.kind ? *options.kind : fill_from_message(*options.message, file, filling);
  fill_duration(false, filling);
  std::string scene = filled(chosen, filling);
  const io::Study study = study_of(scene, file, options.message);
  if (options.message && has_period(study)) {
    fill_duration(true, filling);
    scene = filled(chosen, filling);
    study_of(scene, file, options.message);
  }
  const std::string title = std::visit([](const auto& any) { return any.title; }, study);
  output.add(scene);
  output.put_in_place();
  print(fmt::format("wrote {}: {}\nnext:\n{}", file_text, title,
                    commands_in(scene, options.program)));
  return 0;
}

}  // namespace hamjet::cli
