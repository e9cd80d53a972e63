#include "eval_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "../app/refusal.hpp"
#include "../app/required_tables.hpp"
#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "noted_jet.hpp"

namespace hamjet::cli {
namespace {

/// A scene in place of results: its polynomials are integrated, in the scene's coordinates.
EvalSource integrated_scene(const EvalOptions& options) {
  if (options.time || options.run) {
    refuse(fmt::format("{}: goes with the results of hamjet run, got a scene",
                       options.time ? "--time" : "--run"));
  }
  const Scene scene = io::read_scene(options.directory);
  EvaluatedScene evaluated = study_of(options.directory, [&] { return evaluated_scene(scene); });
  io::StoredJet chief = evaluated.chief;
  return {std::move(chief), std::move(evaluated)};
}

}  // namespace

std::vector<EvalSource> read_eval_sources(const EvalOptions& options) {
  std::error_code none;
  const std::filesystem::path path = options.directory;
  if (path.extension() == ".toml" && !std::filesystem::is_directory(path, none)) {
    return {integrated_scene(options)};
  }
  if (!options.time) return {{read_noted_jet(options.directory, options.run)}};
  std::vector<EvalSource> jets;
  for (io::StoredJet& stored :
       read_noted_jets(options.directory, options.run, wanted_times(*options.time))) {
    jets.push_back({std::move(stored)});
  }
  return jets;
}

}  // namespace hamjet::cli
