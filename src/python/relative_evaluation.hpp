#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../app/deputy_evaluation.hpp"
#include "../app/domain_evaluation.hpp"
#include "../app/eval_coordinates.hpp"
#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::python {

/// The coordinates of relative states, as `hamjet eval` takes them.
struct RelativeCoordinates {
  cli::EvalFrames frames;
  std::optional<int> degree = std::nullopt;
};

/// Names of the columns of a relative state, at the start and at the end. Throws Error(usage) if
/// the coordinates do not fit the jet.
std::vector<std::string> initial_columns(const io::StoredJet& jet,
                                         const RelativeCoordinates& coordinates);
std::vector<std::string> final_columns(const io::StoredJet& jet,
                                       const RelativeCoordinates& coordinates);

/// Where results go: of each of `count` rows the final state (6 numbers), the estimate of the miss
/// in metres (NaN where there is none) and TruncationEstimate::Support as a number.
struct RelativeResults {
  double* states;
  double* miss_m;
  unsigned char* support;
  /// Set where the scene asks for domains; may be null.
  std::optional<cli::EvalDomains>* domains = nullptr;
};

/// What `hamjet eval` does: relative states at the start, rows of 6 numbers, to the end of the
/// jet's duration, with an estimate of the miss. Throws Error(usage) if the
/// coordinates do not fit the jet or a row leaves the variables it is expanded in. `pause` is
/// called now and then and may throw.
void evaluate_relative(const io::StoredJet& jet, const RelativeCoordinates& coordinates,
                       const double* states, std::size_t count, const RelativeResults& results,
                       const std::function<void()>& pause);
/// The same through the polynomials of a scene, in its coordinates; the degree is in range.
void evaluate_relative(const cli::EvaluatedScene& scene, const RelativeCoordinates& coordinates,
                       const double* states, std::size_t count, const RelativeResults& results,
                       const std::function<void()>& pause);

}  // namespace hamjet::python
