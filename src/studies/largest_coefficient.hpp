#pragma once

#include <cmath>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The largest magnitude of a jet's coefficients of one degree; NaN if one of them is NaN.
template <class Real>
double largest_coefficient(const FlowJet<Real>& jet, int degree) {
  double largest = 0;
  for (const auto& component : jet) {
    for (const Real& coefficient : component.slice(degree)) {
      const double magnitude = std::abs(static_cast<double>(coefficient));
      if (!(magnitude <= largest)) largest = magnitude;
      if (std::isnan(largest)) return largest;
    }
  }
  return largest;
}

}  // namespace hamjet
