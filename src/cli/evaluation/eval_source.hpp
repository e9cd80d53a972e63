#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "../../app/deputy_evaluation.hpp"
#include "../scene_options.hpp"
#include "eval_command.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::cli {

/// The name of standard input among files.
inline constexpr std::string_view standard_input = "-";

/// A jet that is stored, or the polynomials of a scene, which are integrated now.
struct EvalSource {
  io::StoredJet stored;
  std::optional<EvaluatedScene> scene = {};

  CanonicalFactors told() const { return scene ? scene->told : CanonicalFactors{}; }
  int order() const { return scene ? scene->flow->order() : stored.order(); }
  ChosenCoordinates coordinates() const { return scene ? scene->coordinates : ChosenCoordinates{}; }
};

/// Reads standard input where the options name it, in place of a scene; once, also if both the
/// polynomials and the deputy are to come from there. Throws as take_standard_input.
void take_standard_input(EvalOptions& options);

/// Whether the polynomials are those of a scene in place of results.
bool is_of_scene(const EvalOptions& options);

/// The scene of this name among the options, that of the polynomials or of the deputy, with the
/// changes that are given. Where both are scenes, another one of the deputy's is taken as it is.
RunOptions scene_named(const EvalOptions& options, const std::string& name);

/// What the options name: stored jets, of one or of several times, or a scene in place of results,
/// whose polynomials are integrated in its coordinates. Throws Error as the readers, and
/// Error(usage) for options that do not go with a scene.
std::vector<EvalSource> read_eval_sources(const EvalOptions& options);

}  // namespace hamjet::cli
