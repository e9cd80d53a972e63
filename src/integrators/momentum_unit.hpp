#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The distance of an orbit's start from the centre, which is the length with which deviations are
/// compared; it is 1 in the default unit of length. A state of an orbit may end with parameters.
inline double initial_distance(std::span<const double> start) {
  double distance = 0;
  const std::size_t positions = std::min<std::size_t>(3, start.size() / 2);
  for (std::size_t i = 0; i < positions; ++i) distance = std::hypot(distance, start[i]);
  return distance;
}

/// The binary exponent of the unit in which momenta are compared with positions, for the canonical
/// unit of length. For an orbit (mu = 1) the unit is the speed on the circle through the start
/// divided by its radius, r^(-3/2), rounded to a power of two. The exponent is 0 in the default
/// unit of length, the chief's distance, and for systems with fixed units. It depends on the start
/// alone, so that it is known for stored jets too; arcs, which know the forces at each cut, use
/// momentum_scale instead.
inline int natural_momentum_exponent(bool is_orbit, std::span<const double> start) {
  return is_orbit ? static_cast<int>(std::lround(-1.5 * std::log2(initial_distance(start)))) : 0;
}

/// The argument `variables` of in_momentum_unit for a jet without some degrees of freedom of its
/// model: for each variable, the index of one of the jet's components of the same kind, position,
/// momentum or parameter. The model has `of_model` degrees of freedom, the jet `of_jet`.
inline std::vector<std::size_t> kinds_of_variables(std::span<const std::size_t> variables,
                                                   std::size_t of_model, std::size_t of_jet) {
  std::vector<std::size_t> result;
  for (const std::size_t v : variables)
    result.push_back(std::min<std::size_t>(v / of_model, 2) * of_jet);
  return result;
}

/// A jet with its momenta, both components and variables, in units of 2^exponent, so that nothing
/// is rounded. Coefficients of one degree are compared with each other, but those of positions and
/// momenta have different units: without a common unit, the largest one would depend on the unit of
/// length. `variables` has the index in z = (q, p, c) of each variable, where q are the first
/// `degrees_of_freedom` numbers; parameters c keep their units. A negative exponent undoes a
/// positive one.
template <class Real>
FlowJet<Real> in_momentum_unit(FlowJet<Real> jet, std::span<const std::size_t> variables,
                               std::size_t degrees_of_freedom, int exponent) {
  if (exponent == 0) return jet;
  const std::size_t n = degrees_of_freedom;
  const auto is_momentum = [n](std::size_t index) { return index >= n && index < 2 * n; };
  const SeriesSpace& space = jet[0].space();
  for (std::size_t k = 0; k < space.size(); ++k) {
    int momenta = 0;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (is_momentum(variables[v])) momenta += space.exponents(k)[v];
    }
    for (std::size_t c = 0; c < jet.size(); ++c) {
      jet[c][k] *= Real(std::ldexp(1.0, exponent * (momenta - (is_momentum(c) ? 1 : 0))));
    }
  }
  return jet;
}

/// The same conversion for a linear map of z = (q, p), with an even number of rows and columns.
template <class LinearMap>
LinearMap in_momentum_unit(LinearMap linear, int exponent) {
  using Real = typename LinearMap::Scalar;
  const auto n = linear.rows() / 2;
  linear.topRightCorner(n, n) *= Real(std::ldexp(1.0, exponent));
  linear.bottomLeftCorner(n, n) *= Real(std::ldexp(1.0, -exponent));
  return linear;
}

}  // namespace hamjet
