#include "relative_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "../app/eval_coordinates.hpp"
#include "../app/jet_evaluation.hpp"
#include "hamjet/error.hpp"

namespace hamjet::python {
namespace {

cli::EvalCoordinates frame_of(const io::StoredJet& stored, const RelativeCoordinates& coordinates) {
  if (coordinates.frames.frame == cli::canonical_frame) {
    throw Error(ErrorKind::usage,
                cli::argument(cli::Caller::module, "frame", cli::canonical_frame) +
                    ": evaluate() takes canonical deviations");
  }
  return {stored, coordinates.frames};
}

/// Carries rows through an evaluation of either kind.
template <class Evaluation>
void carry(const cli::EvalCoordinates& frame, Evaluation& evaluation, const double* states,
           std::size_t count, const RelativeResults& results, const std::function<void()>& pause) {
  constexpr std::size_t columns = 6;
  std::size_t done = 0;
  for (std::size_t row = 0; row < count; ++row) {
    try {
      evaluation.add(frame.variables(std::span(states + row * columns, columns)));
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("row {}: {}", row, error.what()));
    }
    if (evaluation.pending() < Evaluation::most_points && row + 1 < count) continue;
    evaluation.run([&](const std::vector<double>& deviation, cli::MissEstimate estimate) {
      const auto state = frame.final_state(deviation, evaluation.chief_error(), estimate);
      std::copy(state.begin(), state.end(), results.states + done * columns);
      results.miss_m[done] =
          estimate.is_inside() ? estimate.miss_m() : std::numeric_limits<double>::quiet_NaN();
      results.support[done] = static_cast<unsigned char>(estimate.support);
      ++done;
    });
    pause();
  }
}

}  // namespace

std::vector<std::string> initial_columns(const io::StoredJet& jet,
                                         const RelativeCoordinates& coordinates) {
  const cli::EvalCoordinates frame = frame_of(jet, coordinates);
  return {frame.initial_columns().begin(), frame.initial_columns().end()};
}

std::vector<std::string> final_columns(const io::StoredJet& jet,
                                       const RelativeCoordinates& coordinates) {
  const cli::EvalCoordinates frame = frame_of(jet, coordinates);
  return {frame.final_columns().begin(), frame.final_columns().end()};
}

void evaluate_relative(const io::StoredJet& jet, const RelativeCoordinates& coordinates,
                       const double* states, std::size_t count, const RelativeResults& results,
                       const std::function<void()>& pause) {
  cli::JetEvaluation evaluation(jet, coordinates.degree);
  carry(frame_of(jet, coordinates), evaluation, states, count, results, pause);
}

void evaluate_relative(const cli::EvaluatedScene& scene, const RelativeCoordinates& coordinates,
                       const double* states, std::size_t count, const RelativeResults& results,
                       const std::function<void()>& pause) {
  const int degree = coordinates.degree.value_or(scene.flow->order());
  const auto frame = frame_of(scene.chief, coordinates);
  if (!scene.split_scene) {
    cli::DeputyEvaluation evaluation(scene, degree);
    carry(frame, evaluation, states, count, results, pause);
    return;
  }
  cli::DomainEvaluation evaluation(scene, degree, cli::usable_processors(), pause);
  carry(frame, evaluation, states, count, results, pause);
  if (results.domains != nullptr) *results.domains = evaluation.domains();
}

}  // namespace hamjet::python
