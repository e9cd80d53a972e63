#include "eval_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "../../app/refusal.hpp"
#include "../../scene/scene_name.hpp"
#include "../../text/scene_refusal.hpp"
#include "../noted_jet.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {
namespace {

/// A scene in place of results: its polynomials are integrated, in the scene's coordinates.
EvalSource integrated_scene(const EvalOptions& options) {
  if (options.time || options.run) {
    refuse(fmt::format("{}: goes with the results of hamjet run, got a scene",
                       options.time ? "--time" : "--run"));
  }
  const RunOptions named = scene_named(options, options.directory);
  const Scene scene = read_unsplit_scene(named, "hamjet eval");
  note_escape(named, scene);
  EvaluatedScene evaluated =
      io::naming_file(*named.scene_file, [&] { return evaluated_scene(scene); });
  io::StoredJet chief = evaluated.chief;
  return {std::move(chief), std::move(evaluated)};
}

/// Reads the polynomials in the coordinates that the scene of the results asks for, or the jet if
/// there are none.
io::StoredJet read_polynomials_or_jet(const EvalOptions& options) {
  auto polynomials = io::read_stored_polynomials(options.directory, options.run);
  return polynomials ? std::move(*polynomials) : read_noted_jet(options.directory, options.run);
}

EvalSource source_of(io::StoredJet stored) {
  if (stored.coordinates == JetCoordinates::cartesian) return {std::move(stored)};
  EvaluatedScene polynomials = evaluated_jet(stored);
  io::StoredJet chief = polynomials.chief;
  return {std::move(chief), std::move(polynomials)};
}

}  // namespace

void take_standard_input(EvalOptions& options) {
  if (options.directory != standard_input && options.deputy != standard_input) return;
  RunOptions scene;
  scene.scene_file = standard_input;
  take_standard_input(scene);
  options.standard_input = std::move(scene.scene_text);
}

bool is_of_scene(const EvalOptions& options) {
  std::error_code none;
  const std::filesystem::path path = options.directory;
  return options.directory == standard_input ||
         (path.extension() == ".toml" && !std::filesystem::is_directory(path, none));
}

RunOptions scene_named(const EvalOptions& options, const std::string& name) {
  RunOptions scene;
  scene.scene_file = name;
  if (name == standard_input) {
    scene.scene_file = io::standard_input_name;
    scene.scene_text = options.standard_input;
  }
  scene.quiet = options.quiet;
  if (name == options.directory || !is_of_scene(options)) scene.overrides = options.overrides;
  return scene;
}

std::vector<EvalSource> read_eval_sources(const EvalOptions& options) {
  if (is_of_scene(options)) return {integrated_scene(options)};
  if (!options.time) return {source_of(read_polynomials_or_jet(options))};
  std::vector<EvalSource> jets;
  const auto polynomials = io::read_stored_polynomials(options.directory, options.run);
  for (io::StoredJet& stored :
       read_noted_jets(options.directory, options.run, wanted_times(*options.time))) {
    // Polynomials in other coordinates exist for the duration alone.
    const bool is_at_duration = polynomials && polynomials->duration == stored.duration;
    jets.push_back(source_of(is_at_duration ? *polynomials : std::move(stored)));
  }
  return jets;
}

}  // namespace hamjet::cli
