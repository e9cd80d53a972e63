#include "stability_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "rounding_sample.hpp"

namespace hamjet {
namespace {

/// The jet of all components of the model; components that vanish identically are zero series.
FlowJet<Extended> full_jet(const PropagationResult& result) {
  FlowJet<Extended> full(result.scene.nominal.size(), Series<Extended>(result.problem.space));
  const FlowJet<Extended>& jet = result.runs.front().jet;
  for (std::size_t i = 0; i < jet.size(); ++i) full[result.problem.components[i]] = jet[i];
  return full;
}

double distance(const Extended& value, const Extended& reference) {
  return static_cast<double>(Extended(abs(value - reference)));
}

/// Keeps the error with the larger ratio to the allowed one; for equal ratios, the larger error.
void keep_worse(std::optional<MeasuredError>& worst, const MeasuredError& error) {
  const bool is_worse = !worst || error.ratio() > worst->ratio() ||
                        (error.ratio() == worst->ratio() && error.error > worst->error);
  if (is_worse) worst = error;
}

void require_size(const char* key, std::size_t got, std::size_t wanted) {
  if (got == wanted) return;
  throw Error(ErrorKind::usage, fmt::format("case.{}: {} numbers, must be {}", key, got, wanted));
}

MeasuredError worst_of_state(const StabilityExpectation& expected, const FlowJet<Extended>& jet,
                             const RoundingFloor& floor) {
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < expected.state.size(); ++i) {
    keep_worse(worst, {"state", distance(jet[i][0], expected.state[i]), floor.state[i],
                       expected.tolerance});
  }
  return *worst;
}

MeasuredError worst_of_matrix(const StabilityExpectation& expected, const FlowJet<Extended>& jet,
                              const std::vector<std::size_t>& variables,
                              const RoundingFloor& floor) {
  const std::size_t dimension = jet.size();
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < dimension; ++i) {
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const std::size_t entry = i * dimension + variables[k];
      const Extended& value = jet[i][jet[i].space().linear_index(k)];
      // An entry is exactly 0 only by symmetry, and symmetry must be kept exactly.
      const bool is_zero = expected.matrix[entry] == 0;
      keep_worse(worst, {"matrix", distance(value, expected.matrix[entry]),
                         is_zero ? 0 : floor.matrix[entry], is_zero ? 0 : expected.tolerance});
    }
  }
  return *worst;
}

/// Reports the progress of the rounding sample to the user.
std::function<void(double)> sampling(const ProgressCallback& progress) {
  return [&progress](double done) {
    if (progress) progress("rounding", done);
  };
}

void add_reference_errors(const StabilityExpectation& expected, const PropagationResult& result,
                          const ProgressCallback& progress, std::vector<MeasuredError>& errors) {
  if (expected.state.empty() && expected.matrix.empty()) return;
  const std::size_t dimension = result.scene.nominal.size();
  if (!expected.state.empty()) require_size("state", expected.state.size(), dimension);
  if (!expected.matrix.empty()) {
    require_size("matrix", expected.matrix.size(), dimension * dimension);
  }
  const FlowJet<Extended> jet = full_jet(result);
  RoundingSample sample;
  sample.follow(result.scene, result.problem, sampling(progress));
  if (!expected.state.empty()) {
    errors.push_back(worst_of_state(expected, jet, sample.floor()));
  }
  if (!expected.matrix.empty()) {
    errors.push_back(worst_of_matrix(expected, jet, result.scene.variables, sample.floor()));
  }
}

/// Runs a scene; a failure of its run is thrown as a failure of the case.
PropagationResult propagate_well(const Scene& scene, const ProgressCallback& progress) {
  PropagationResult result = propagate(scene, progress);
  if (!result.runs.front().failure.empty()) {
    throw Error(ErrorKind::numerical, result.runs.front().failure);
  }
  return result;
}

void add_twin_errors(const StabilityExpectation& expected, const PropagationResult& result,
                     const ProgressCallback& progress, std::vector<MeasuredError>& errors) {
  if (!expected.twin) return;
  const PropagationResult twin = propagate_well(*expected.twin, progress);
  if (twin.scene.variables != result.scene.variables) {
    throw Error(ErrorKind::usage, "case.twin: is expanded in other variables than the case");
  }
  const auto by_degree = relative_error_by_degree(full_jet(result), full_jet(twin));
  for (std::size_t d = 0; d < by_degree.size(); ++d) {
    errors.push_back({fmt::format("twin, degree {}", d), by_degree[d], 0, expected.tolerance});
  }
}

void add_round_trip_error(const StabilityExpectation& expected, const PropagationResult& result,
                          const ProgressCallback& progress, std::vector<MeasuredError>& errors) {
  if (!expected.round_trip) return;
  Scene back = result.scene;
  back.nominal = result.runs.front().nominal_final;
  back.start_time = result.scene.start_time + result.scene.duration;
  back.duration = -back.duration;
  const PropagationResult returned = propagate_well(back, progress);
  RoundingSample sample;
  sample.follow(result.scene, result.problem, sampling(progress));
  sample.follow(back, returned.problem, sampling(progress));
  const FlowJet<Extended> jet = full_jet(returned);
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < back.nominal.size(); ++i) {
    keep_worse(worst,
               {"start, out and back", distance(jet[i][0], Extended(result.scene.nominal[i])),
                sample.floor().state[i], expected.tolerance});
  }
  errors.push_back(*worst);
}

void add_condition_error(const StabilityExpectation& expected, const PropagationResult& result,
                         std::vector<MeasuredError>& errors) {
  if (!expected.condition) return;
  for (const KindResult& kind : result.runs.front().kinds) {
    if (kind.requested != expected.condition->kind) continue;
    errors.push_back({"condition of " + kind.requested,
                      std::abs(kind.condition / expected.condition->value - 1), 0,
                      expected.tolerance});
    return;
  }
  throw Error(ErrorKind::usage,
              fmt::format("case.condition: the scene does not ask for the kind {}",
                          expected.condition->kind));
}

}  // namespace

double MeasuredError::ratio() const {
  if (error == 0) return 0;
  const double quotient = error / allowed();
  return std::isnan(quotient) ? std::numeric_limits<double>::infinity() : quotient;
}

std::vector<MeasuredError> measure_errors(const StabilityExpectation& expected,
                                          const PropagationResult& result,
                                          const ProgressCallback& progress) {
  std::vector<MeasuredError> errors;
  add_reference_errors(expected, result, progress, errors);
  add_twin_errors(expected, result, progress, errors);
  add_round_trip_error(expected, result, progress, errors);
  add_condition_error(expected, result, errors);
  return errors;
}

}  // namespace hamjet
