#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The components of a jet along a line through the origin of the deviations, as series in s. The
/// deviations are s times `direction`, which has an entry for each variable; the coefficient of
/// degree d is the sum over |a| = d of c_a direction^a. `line` is a space of one variable and of
/// the jet's order.
template <class Real>
FlowJet<Real> restrict_to_line(const FlowJet<Real>& jet, const std::vector<Real>& direction,
                               const SpacePointer& line) {
  const SeriesSpace& space = jet[0].space();
  std::vector<std::vector<Real>> powers;  // powers of each variable's entry
  for (const Real& entry : direction) {
    std::vector<Real>& of = powers.emplace_back(1, Real(1));
    for (int d = 0; d < space.order(); ++d) of.push_back(of.back() * entry);
  }
  FlowJet<Real> result(jet.size(), Series<Real>(line));
  for (std::size_t k = 0; k < space.size(); ++k) {
    const auto exponents = space.exponents(k);
    Real monomial(1);
    for (std::size_t v = 0; v < exponents.size(); ++v) {
      if (exponents[v] > 0) monomial *= powers[v][exponents[v]];
    }
    const auto degree = static_cast<std::size_t>(space.degree(k));
    for (std::size_t i = 0; i < jet.size(); ++i) result[i][degree] += jet[i][k] * monomial;
  }
  return result;
}

}  // namespace hamjet
