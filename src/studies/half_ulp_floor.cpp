#include "half_ulp_floor.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "largest_coefficient.hpp"

namespace hamjet {
namespace {

constexpr double half_ulp = 0x1p-53;

double magnitude_of(const Extended& value) { return std::abs(static_cast<double>(value)); }

}  // namespace

std::vector<double> half_ulp_floor(const Scene& scene, const ComputedProblem& problem,
                                   const FlowJet<Extended>& jet) {
  const auto slopes = evaluate_on_series<Extended>(problem.system.vector_field,
                                                   std::span<const Series<Extended>>(jet));
  std::vector<double> floor(scene.nominal.size(), 0);
  for (std::size_t i = 0; i < jet.size(); ++i) {
    double sum = magnitude_of(slopes[i][0]) * std::abs(scene.duration) + magnitude_of(jet[i][0]);
    for (std::size_t j = 0; j < scene.variables.size(); ++j) {
      sum += magnitude_of(jet[i][problem.space->linear_index(j)]) *
             std::abs(scene.nominal[scene.variables[j]]);
    }
    floor[problem.components[i]] = half_ulp * sum;
  }
  return floor;
}

double matrix_floor(const Scene& scene, const ComputedProblem& problem,
                    const FlowJet<Extended>& jet, const std::vector<double>& state_floor) {
  const std::size_t n = scene.nominal.size() / 2;
  double size[2] = {0, 0};  // of positions and of momenta, at the start or at the end
  for (std::size_t i = 0; i < jet.size(); ++i) {
    const std::size_t component = problem.components[i];
    double& kind = size[component < n ? 0 : 1];
    kind = std::max({kind, std::abs(scene.nominal[component]), magnitude_of(jet[i][0])});
  }
  double relative = half_ulp;
  for (std::size_t i = 0; i < state_floor.size(); ++i) {
    const double scale = size[i < n ? 0 : 1];
    if (scale > 0) relative = std::max(relative, state_floor[i] / scale);
  }
  return relative * largest_coefficient(jet, 1);
}

}  // namespace hamjet
