#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "../../integrators/jet_directions.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../formation_scale.hpp"
#include "hamjet/algebra/calculus.hpp"

// Degrees of a jet that deviations as large as the nominal get nothing from but rounding: those
// that vanish, where terms of the forces cancel in numbers alone, or but for the rounding of the
// nominal.

namespace hamjet {

/// What a degree may be of the linear part, at deviations as large as the nominal, and be none.
inline constexpr double largest_negligible_share = 1e-12;

/// By degree from 1 on, what the jet's largest coefficient makes of the linear part at deviations
/// as large as the nominal, size_of_nominal; entry 0 is 1.
template <class Real>
std::vector<double> shares_of_linear(const Scene& scene, const FlowProblem<Real>& flow,
                                     const FlowJet<Real>& jet, int momentum_exponent) {
  std::vector<double> shares = largest_by_degree(
      compared_components(jet, flow.variables, flow.system->degrees_of_freedom, momentum_exponent));
  const double linear = shares.size() > 1 ? shares[1] : 0;
  const double size = size_of_nominal(scene);
  for (std::size_t d = 0; d < shares.size(); ++d) {
    const double power = std::pow(size, static_cast<double>(d) - 1);
    shares[d] = d == 0 || !(linear > 0) ? 1 : shares[d] * power / linear;
  }
  return shares;
}

/// The highest degree that is not negligible.
inline int last_degree(const std::vector<double>& shares) {
  std::size_t last = shares.size() - 1;
  while (last > 1 && shares[last] < largest_negligible_share) --last;
  return static_cast<int>(last);
}

/// The flow without the degrees above one.
template <class Real>
FlowProblem<Real> of_lower_order(FlowProblem<Real> flow, int order) {
  flow.space = SeriesSpace::create(flow.space->variables(), order);
  if (flow.initial_jet) {
    for (Series<Real>& component : *flow.initial_jet) component = in_space(component, flow.space);
  }
  return flow;
}

template <class Real>
FlowJet<Real> of_lower_order(FlowJet<Real> jet, const SpacePointer& space) {
  for (Series<Real>& component : jet) component = in_space(component, space);
  return jet;
}

/// Tells the errors of negligible degrees that have no right digit relative to the linear part,
/// beside which they count, and no longer relative to coefficients that are rounding themselves.
inline void tell_beside_linear(std::vector<double>& errors, const std::vector<double>& shares) {
  constexpr double no_digit = 0.1;
  for (std::size_t d = 2; d < errors.size(); ++d) {
    if (shares[d] < largest_negligible_share && errors[d] > no_digit) errors[d] *= shares[d];
  }
}

}  // namespace hamjet
