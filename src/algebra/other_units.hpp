#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// A series whose value and variables are given in other units. The factors convert numbers into
/// these units: a coefficient is multiplied by the factor of the value and divided by that of each
/// variable, as often as the variable stands in the monomial. `of_variables` has one factor for
/// each variable.
template <class T>
Series<T> in_other_units(Series<T> u, const T& of_value, std::span<const T> of_variables) {
  const SeriesSpace& space = u.space();
  for (std::size_t k = 0; k < space.size(); ++k) {
    const auto exponents = space.exponents(k);
    T factor = of_value;
    for (std::size_t v = 0; v < of_variables.size(); ++v) {
      for (int e = 0; e < exponents[v]; ++e) factor /= of_variables[v];
    }
    u[k] *= factor;
  }
  return u;
}

/// Converts a map in place; each component has a factor of its own.
template <class T>
void tell_in_other_units(std::span<Series<T>> map, std::span<const T> of_values,
                         std::span<const T> of_variables) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    map[i] = in_other_units<T>(std::move(map[i]), of_values[i], of_variables);
  }
}

}  // namespace hamjet
