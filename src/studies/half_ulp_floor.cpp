#include "half_ulp_floor.hpp"

#include <cmath>
#include <cstdint>
#include <span>

#include "hamjet/dynamics/relative_hamiltonian.hpp"

namespace hamjet {
namespace {

constexpr double half_ulp = 0x1p-53;

double magnitude_of(const Extended& value) { return std::abs(static_cast<double>(value)); }

/// Second derivative of a series by the variables j and k, in magnitude.
double second_derivative(const Series<Extended>& series, std::size_t j, std::size_t k) {
  std::vector<std::uint8_t> exponents(series.space().variables(), 0);
  ++exponents[j];
  ++exponents[k];
  return magnitude_of(series[series.space().index(exponents)]) * (j == k ? 2 : 1);
}

}  // namespace

HalfUlpFloor half_ulp_floor(const Scene& scene, const ComputedProblem& problem,
                            const FlowJet<Extended>& jet) {
  const std::size_t dimension = scene.nominal.size();
  const SeriesSpace& space = *problem.space;
  const bool has_matrix = space.order() >= 2;
  const auto slopes = evaluate_on_series<Extended>(problem.system.vector_field,
                                                   std::span<const Series<Extended>>(jet));
  const double span = std::abs(scene.duration);
  HalfUlpFloor floor;
  floor.state.assign(dimension, 0);
  if (has_matrix) floor.matrix.assign(dimension * dimension, 0);
  for (std::size_t i = 0; i < jet.size(); ++i) {
    const std::size_t row = problem.components[i];
    double sum = magnitude_of(slopes[i][0]) * span + magnitude_of(jet[i][0]);
    for (std::size_t j = 0; j < scene.variables.size(); ++j) {
      const std::size_t linear = space.linear_index(j);
      sum += magnitude_of(jet[i][linear]) * std::abs(scene.nominal[scene.variables[j]]);
      if (!has_matrix) continue;
      double entry = magnitude_of(slopes[i][linear]) * span + magnitude_of(jet[i][linear]);
      for (std::size_t k = 0; k < scene.variables.size(); ++k) {
        entry += second_derivative(jet[i], j, k) * std::abs(scene.nominal[scene.variables[k]]);
      }
      floor.matrix[row * dimension + scene.variables[j]] = half_ulp * entry;
    }
    floor.state[row] = half_ulp * sum;
  }
  return floor;
}

}  // namespace hamjet
