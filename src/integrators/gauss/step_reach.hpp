#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// The distance by which the positions, or the components of a system of first order, move in a
/// step h with the slopes at its start. `start(i)` is component i of the state there.
template <class Real, int Lanes, class Start>
double step_reach(const StageSystem<Real, Lanes>& system, const std::vector<Real>& slopes,
                  const Start& start, const Real& h) {
  const double size = std::abs(static_cast<double>(h));
  const std::size_t m = system.components();
  double result = 0;
  for (std::size_t c = 0; c < m; ++c) {
    double distance = size * std::abs(static_cast<double>(slopes[c]));
    if (system.second_order()) {
      Real velocity = system.unit_mass() ? start(m + c) : Real(0);
      for (std::size_t i = 0; i < m && !system.unit_mass(); ++i) {
        velocity += system.inverse_mass(c, i) * start(m + i);
      }
      distance = size * (std::abs(static_cast<double>(velocity)) + distance);
    }
    result = std::max(result, distance);
  }
  return result;
}

/// The largest change of a slope between two solutions, over all components and stages.
template <class Real, int Lanes>
double largest_change(const std::vector<Pack<Real, Lanes>>& before,
                      const std::vector<Pack<Real, Lanes>>& after, int stages) {
  double result = 0;
  for (std::size_t c = 0; c < before.size(); ++c) {
    const Pack<Real, Lanes> difference = after[c] - before[c];
    for (int i = 0; i < stages; ++i) {
      result = std::max(result, std::abs(static_cast<double>(difference.lane(i))));
    }
  }
  return result;
}

}  // namespace hamjet
