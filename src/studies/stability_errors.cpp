#include "stability_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "half_ulp_floor.hpp"

namespace hamjet {
namespace {

/// The jet of all components of the model; those that vanish identically are zero series.
FlowJet<Extended> full_jet(const PropagationResult& result) {
  FlowJet<Extended> full(result.scene.nominal.size(), Series<Extended>(result.problem.space));
  const FlowJet<Extended>& jet = result.runs.front().jet;
  for (std::size_t i = 0; i < jet.size(); ++i) full[result.problem.components[i]] = jet[i];
  return full;
}

double distance(const Extended& value, const Extended& reference) {
  return static_cast<double>(Extended(abs(value - reference)));
}

/// The worse of the two, by how far it exceeds what it may be; of equal ones the greater error.
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
                             const std::vector<double>& floor) {
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < expected.state.size(); ++i) {
    keep_worse(worst, {"state", distance(jet[i][0], expected.state[i]), floor[i],
                       expected.tolerance, expected.floor_factor});
  }
  return *worst;
}

MeasuredError worst_of_matrix(const StabilityExpectation& expected, const FlowJet<Extended>& jet,
                              const std::vector<std::size_t>& variables, double floor) {
  const std::size_t dimension = jet.size();
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < dimension; ++i) {
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const std::size_t entry = i * dimension + variables[k];
      const Extended& value = jet[i][jet[i].space().linear_index(k)];
      // Symmetry alone makes an entry exactly 0, and it must be kept.
      const bool is_zero = expected.matrix[entry] == 0;
      keep_worse(worst, {"matrix", distance(value, expected.matrix[entry]), is_zero ? 0 : floor,
                         is_zero ? 0 : expected.tolerance, expected.floor_factor});
    }
  }
  return *worst;
}

void add_reference_errors(const StabilityExpectation& expected, const PropagationResult& result,
                          std::vector<MeasuredError>& errors) {
  if (expected.state.empty() && expected.matrix.empty()) return;
  const std::size_t dimension = result.scene.nominal.size();
  const FlowJet<Extended>& computed = result.runs.front().jet;
  const FlowJet<Extended> jet = full_jet(result);
  const std::vector<double> floor = expected.state_floor.empty()
                                        ? half_ulp_floor(result.scene, result.problem, computed)
                                        : expected.state_floor;
  require_size("state_floor", floor.size(), dimension);
  if (!expected.state.empty()) {
    require_size("state", expected.state.size(), dimension);
    errors.push_back(worst_of_state(expected, jet, floor));
  }
  if (!expected.matrix.empty()) {
    require_size("matrix", expected.matrix.size(), dimension * dimension);
    errors.push_back(worst_of_matrix(expected, jet, result.scene.variables,
                                     matrix_floor(result.scene, result.problem, computed, floor)));
  }
}

/// A run whose failure is the case's.
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
    errors.push_back({fmt::format("twin, degree {}", d), by_degree[d], 0, expected.tolerance,
                      expected.floor_factor});
  }
}

void add_round_trip_error(const StabilityExpectation& expected, const PropagationResult& result,
                          const ProgressCallback& progress, std::vector<MeasuredError>& errors) {
  if (!expected.round_trip) return;
  Scene back = result.scene;
  back.nominal = result.runs.front().nominal_final;
  back.duration = -back.duration;
  const PropagationResult returned = propagate_well(back, progress);
  const auto out = half_ulp_floor(result.scene, result.problem, result.runs.front().jet);
  const auto home = half_ulp_floor(back, returned.problem, returned.runs.front().jet);
  const FlowJet<Extended> jet = full_jet(returned);
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < back.nominal.size(); ++i) {
    double floor = home[i];  // and what the way out has lost, carried back
    for (std::size_t k = 0; k < back.variables.size(); ++k) {
      const std::size_t linear = returned.problem.space->linear_index(k);
      floor += std::abs(static_cast<double>(jet[i][linear])) * out[back.variables[k]];
    }
    keep_worse(worst,
               {"start, out and back", distance(jet[i][0], Extended(result.scene.nominal[i])),
                floor, expected.tolerance, expected.floor_factor});
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
                      expected.tolerance, expected.floor_factor});
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
  add_reference_errors(expected, result, errors);
  add_twin_errors(expected, result, progress, errors);
  add_round_trip_error(expected, result, progress, errors);
  add_condition_error(expected, result, errors);
  return errors;
}

}  // namespace hamjet
