#include "stability_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "half_ulp_floor.hpp"

namespace hamjet {
namespace {

/// The coefficient of a component of the model; of one that vanishes identically it is 0.
Extended coefficient(const PropagationResult& result, std::size_t component, std::size_t monomial) {
  const auto& components = result.problem.components;
  const auto place = std::find(components.begin(), components.end(), component);
  if (place == components.end()) return 0;
  return result.runs.front().jet[static_cast<std::size_t>(place - components.begin())][monomial];
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

MeasuredError worst_of_state(const StabilityExpectation& expected, const PropagationResult& result,
                             const std::vector<double>& floor) {
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < expected.state.size(); ++i) {
    keep_worse(worst, {"state", distance(coefficient(result, i, 0), expected.state[i]), floor[i],
                       expected.tolerance, expected.floor_factor});
  }
  return *worst;
}

MeasuredError worst_of_matrix(const StabilityExpectation& expected, const PropagationResult& result,
                              double floor) {
  const std::size_t dimension = result.scene.nominal.size();
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < dimension; ++i) {
    for (std::size_t k = 0; k < result.scene.variables.size(); ++k) {
      const std::size_t entry = i * dimension + result.scene.variables[k];
      const Extended value = coefficient(result, i, result.problem.space->linear_index(k));
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
  HalfUlpFloor floor = half_ulp_floor(result.scene, result.problem, result.runs.front().jet);
  if (!expected.state_floor.empty()) floor.state = expected.state_floor;
  require_size("state_floor", floor.state.size(), dimension);
  if (!expected.state.empty()) {
    require_size("state", expected.state.size(), dimension);
    errors.push_back(worst_of_state(expected, result, floor.state));
  }
  if (!expected.matrix.empty()) {
    require_size("matrix", expected.matrix.size(), dimension * dimension);
    errors.push_back(worst_of_matrix(
        expected, result,
        matrix_floor(result.scene, result.problem, result.runs.front().jet, floor.state)));
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
  const SeriesSpace& space = *result.problem.space;
  for (int d = 0; d <= std::min(result.scene.order, twin.scene.order); ++d) {
    double difference = 0;
    double largest = 0;
    for (std::size_t i = 0; i < result.scene.nominal.size(); ++i) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        const Extended value = coefficient(twin, i, k);
        difference = std::max(difference, distance(coefficient(result, i, k), value));
        largest = std::max(largest, std::abs(static_cast<double>(value)));
      }
    }
    errors.push_back({fmt::format("twin, degree {}", d),
                      largest > 0 ? difference / largest : difference, 0, expected.tolerance,
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
  const auto out = half_ulp_floor(result.scene, result.problem, result.runs.front().jet).state;
  const auto home = half_ulp_floor(back, returned.problem, returned.runs.front().jet).state;
  std::optional<MeasuredError> worst;
  for (std::size_t i = 0; i < back.nominal.size(); ++i) {
    double floor = home[i];  // and what the way out has lost, carried back
    for (std::size_t k = 0; k < back.variables.size(); ++k) {
      const std::size_t linear = returned.problem.space->linear_index(k);
      floor +=
          std::abs(static_cast<double>(coefficient(returned, i, linear))) * out[back.variables[k]];
    }
    keep_worse(worst, {"start, out and back",
                       distance(coefficient(returned, i, 0), Extended(result.scene.nominal[i])),
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
