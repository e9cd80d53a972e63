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

}  // namespace

std::vector<std::string> initial_columns(const Jet& jet, const RelativeCoordinates& coordinates) {
  const cli::EvalCoordinates frame = frame_of(jet.stored(), coordinates);
  return {frame.initial_columns().begin(), frame.initial_columns().end()};
}

std::vector<std::string> final_columns(const Jet& jet, const RelativeCoordinates& coordinates) {
  const cli::EvalCoordinates frame = frame_of(jet.stored(), coordinates);
  return {frame.final_columns().begin(), frame.final_columns().end()};
}

void evaluate_relative(const Jet& jet, const RelativeCoordinates& coordinates, const double* states,
                       std::size_t count, const RelativeResults& results,
                       const std::function<void()>& pause) {
  constexpr std::size_t columns = 6;
  const io::StoredJet& stored = jet.stored();
  if (coordinates.degree) jet.deviation_to(*coordinates.degree);  // refuses what is out of range
  const cli::EvalCoordinates frame = frame_of(stored, coordinates);
  cli::JetEvaluation evaluation(stored, coordinates.degree);
  std::size_t done = 0;
  for (std::size_t row = 0; row < count; ++row) {
    try {
      evaluation.add(frame.variables(std::span(states + row * columns, columns)));
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("row {}: {}", row, error.what()));
    }
    if (evaluation.pending() < cli::JetEvaluation::most_points && row + 1 < count) continue;
    evaluation.run([&](const std::vector<double>& deviation, const cli::MissEstimate& estimate) {
      const auto state = frame.final_state(deviation);
      std::copy(state.begin(), state.end(), results.states + done * columns);
      results.miss_m[done] =
          estimate.is_inside() ? estimate.miss_m() : std::numeric_limits<double>::quiet_NaN();
      results.support[done] = static_cast<unsigned char>(estimate.support);
      ++done;
    });
    pause();
  }
}

}  // namespace hamjet::python
