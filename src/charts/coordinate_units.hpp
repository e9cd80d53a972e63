#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "../algebra/other_units.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The units of a chart's coordinates that suit the chief, made of its distance r from the centre
/// and the angular momentum L = sqrt(mu r) of a circle there: r, L/r, L, sqrt(L) for a pair of
/// elements, and 1 for an angle. All are 1 in canonical units whose unit of length is r.
inline std::array<double, 6> coordinate_units(ChartName chart, double distance, double mu) {
  const double action = std::sqrt(mu * distance);
  const double momentum = action / distance;
  const double pair = std::sqrt(action);
  switch (chart) {
    case ChartName::spherical:
      return {1, distance, 1, action, momentum, action};
    case ChartName::cylindrical:
      return {1, distance, distance, action, momentum, momentum};
    case ChartName::poincare:
      return {1, pair, pair, action, pair, pair};
    case ChartName::nodal:
      return {1, 1, pair, action, action, pair};
    case ChartName::cartesian:
      break;
  }
  return {distance, distance, distance, momentum, momentum, momentum};
}

/// A map whose values and variables are given in these units.
inline FlowJet<Extended> in_units(FlowJet<Extended> map, std::span<const double> of_values,
                                  std::span<const double> of_variables) {
  const auto factors = [](std::span<const double> units) {
    std::vector<Extended> inverses;
    for (const double unit : units) inverses.push_back(1 / Extended(unit));
    return inverses;
  };
  tell_in_other_units<Extended>(map, factors(of_values), factors(of_variables));
  return map;
}

/// The units of a flow box's polynomials that suit the chief, for sections in one chart.
/// Coefficients of one degree can be compared once variables and values are in these units.
struct FlowBoxUnits {
  FlowBoxUnits(ChartName section, double distance, double mu) {
    const std::array<double, 6> units = coordinate_units(section, distance, mu);
    // The relative difference of periods (or of energies, in the chief's unit of energy) has no
    // unit.
    variables.push_back(1);
    values.push_back(distance * std::sqrt(distance / mu));
    const bool ignores_node = section == ChartName::nodal;
    for (const std::size_t place :
         {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{5}}) {
      if (place == 1 && ignores_node) continue;
      variables.push_back(units[place]);
      values.push_back(units[place]);
    }
    if (ignores_node) values.push_back(1);
  }

  std::vector<double> variables;
  std::vector<double> values;
};

}  // namespace hamjet
