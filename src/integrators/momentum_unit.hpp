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

/// The binary exponent of 1/r for that of r^(-3/2), natural_momentum_exponent.
inline int parameter_exponent(int momentum_exponent) {
  return static_cast<int>(std::lround(momentum_exponent / 1.5));
}

/// The binary exponent of the unit of the variable with an index in z = (q, p, c).
inline int exponent_of_variable(std::size_t index, std::size_t degrees_of_freedom,
                                int momentum_exponent) {
  if (index < degrees_of_freedom) return 0;
  return index < 2 * degrees_of_freedom ? momentum_exponent : parameter_exponent(momentum_exponent);
}

/// A jet with its momenta, both components and variables, in units of 2^exponent, so that nothing
/// is rounded. Coefficients of one degree are compared with each other, but those of positions and
/// momenta have different units: without a common unit, the largest one would depend on the unit of
/// length. `variables` has the index in z = (q, p, c) of each variable, where q are the first
/// `degrees_of_freedom` numbers. A negative exponent undoes a positive one.
///
/// Coefficients of degree d in units of the orbit's distance r are r^(d-1) times those in the
/// canonical unit; a factor that all have alike changes no comparison, but those of k parameters
/// have r^(d-k-1). Parameters as variables are therefore in units of 1/r, see parameter_exponent;
/// as components they keep their units.
template <class Real>
FlowJet<Real> in_momentum_unit(FlowJet<Real> jet, std::span<const std::size_t> variables,
                               std::size_t degrees_of_freedom, int exponent) {
  if (exponent == 0) return jet;
  const std::size_t n = degrees_of_freedom;
  const auto is_momentum = [n](std::size_t index) { return index >= n && index < 2 * n; };
  const SeriesSpace& space = jet[0].space();
  for (std::size_t k = 0; k < space.size(); ++k) {
    int of_variables = 0;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      of_variables += space.exponents(k)[v] * exponent_of_variable(variables[v], n, exponent);
    }
    for (std::size_t c = 0; c < jet.size(); ++c) {
      jet[c][k] *= Real(std::ldexp(1.0, of_variables - (is_momentum(c) ? exponent : 0)));
    }
  }
  return jet;
}

/// The same of the positions and momenta alone: parameters are kept by a flow without an error, and
/// have no unit in which they could be compared.
template <class Real>
FlowJet<Real> compared_components(FlowJet<Real> jet, std::span<const std::size_t> variables,
                                  std::size_t degrees_of_freedom, int exponent) {
  const auto all = static_cast<std::ptrdiff_t>(std::min(jet.size(), 2 * degrees_of_freedom));
  jet.erase(jet.begin() + all, jet.end());
  return in_momentum_unit(std::move(jet), variables, degrees_of_freedom, exponent);
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
