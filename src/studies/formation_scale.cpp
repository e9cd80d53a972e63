#include "formation_scale.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "../integrators/momentum_unit.hpp"
#include "descriptions/system_description.hpp"
#include "nominal/nominal_period.hpp"
#include "random_direction.hpp"

namespace hamjet {
namespace {

constexpr int random_points = 100;

}  // namespace

double momentum_per_length(const Scene& scene) {
  const auto period = nominal_period(scene);
  if (description_of(scene.system.model).period_s != nullptr) {
    return scene.system.mass_kg * 2 * std::numbers::pi / *period;
  }
  if (period) return 2 * std::numbers::pi / *period;
  return is_orbit(scene.system.model) ? std::pow(initial_distance(scene.nominal), -1.5) : 1;
}

double size_of_nominal(const Scene& scene) {
  if (is_orbit(scene.system.model)) return initial_distance(scene.nominal);
  const std::size_t n = scene.nominal.size() / 2;
  const auto norm = [&](std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < first + n; ++i) sum += scene.nominal[i] * scene.nominal[i];
    return std::sqrt(sum);
  };
  const double size = std::max(norm(0), norm(n));
  return size > 0 ? size : 1;
}

FormationPoints::FormationPoints(const Scene& scene, const ComputedProblem& problem)
    : positions_(problem.degrees_of_freedom.size()), metres_(scene.units.length_km * 1000) {
  const double separation = scene.separation.value_or(0);
  const double momentum = separation * momentum_per_length(scene);
  const std::size_t variables = problem.variables.size();
  std::vector<std::size_t> position_variables;
  std::vector<std::size_t> momentum_variables;
  for (std::size_t v = 0; v < variables; ++v) {
    (problem.variables[v] < positions_ ? position_variables : momentum_variables).push_back(v);
  }
  for (const std::size_t v : position_variables) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> point(variables, 0);
      point[v] = sign * separation;
      points_.push_back(std::move(point));
    }
  }
  std::mt19937_64 generator(1);
  for (int k = 0; k < random_points; ++k) {
    std::vector<double> point(variables, 0);
    const auto add = [&](const std::vector<std::size_t>& where, double size) {
      if (where.empty()) return;
      const auto direction = random_direction(generator, where.size());
      for (std::size_t i = 0; i < where.size(); ++i) point[where[i]] = size * direction[i];
    };
    add(position_variables, separation);
    if (k % 2 == 1 || position_variables.empty()) add(momentum_variables, momentum);
    points_.push_back(std::move(point));
  }
}

double FormationPoints::position_error_m(const FlowJet<Extended>& jet,
                                         const FlowJet<Extended>& reference) const {
  const SeriesSpace& space = reference[0].space();
  // The coefficients are subtracted in extended precision; the small differences are evaluated in
  // double precision.
  std::vector<std::vector<double>> differences(positions_, std::vector<double>(space.size()));
  for (std::size_t i = 0; i < positions_; ++i) {
    for (std::size_t k = 0; k < space.size(); ++k) {
      differences[i][k] = static_cast<double>(Extended(jet[i][k] - reference[i][k]));
    }
  }
  double largest = 0;
  for (const auto& point : points_) {
    std::vector<double> sums(positions_, 0);
    for (std::size_t k = 0; k < space.size(); ++k) {
      double monomial = 1;
      const auto exponents = space.exponents(k);
      for (std::size_t v = 0; v < point.size(); ++v) {
        for (int e = 0; e < exponents[v]; ++e) monomial *= point[v];
      }
      for (std::size_t i = 0; i < positions_; ++i) sums[i] += monomial * differences[i][k];
    }
    double square = 0;
    for (const double x : sums) square += x * x;
    largest = std::max(largest, std::sqrt(square));
  }
  return largest * metres_;
}

}  // namespace hamjet
