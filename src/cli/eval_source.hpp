#pragma once

#include <optional>
#include <vector>

#include "../app/deputy_evaluation.hpp"
#include "eval_command.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::cli {

/// A jet that is stored, or the polynomials of a scene, which are integrated now.
struct EvalSource {
  io::StoredJet stored;
  std::optional<EvaluatedScene> scene = {};

  int order() const { return scene ? scene->flow->order() : stored.order(); }
  JetCoordinates coordinates() const {
    return scene ? scene->coordinates : JetCoordinates::cartesian;
  }
};

/// What the options name: stored jets, of one or of several times, or a scene in place of results,
/// whose polynomials are integrated in its coordinates. Throws Error as the readers, and
/// Error(usage) for options that do not go with a scene.
std::vector<EvalSource> read_eval_sources(const EvalOptions& options);

}  // namespace hamjet::cli
