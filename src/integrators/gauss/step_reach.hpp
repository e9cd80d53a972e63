#pragma once

#include <cmath>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "stage_slopes.hpp"

namespace hamjet {

/// The distance by which the positions, or the components of a system of first order, move in a
/// step h with the slopes at its start. `start(i)` is component i of the state there.
template <class Real, int Lanes, class Start>
double step_reach(const StageSlopes<Real, Lanes>& stages, const std::vector<Real>& slopes,
                  const Start& start, const Real& h) {
  const StageSystem<Real, Lanes>& system = stages.system();
  const double size = std::abs(static_cast<double>(h));
  const std::size_t m = system.components();
  return stages.template largest_component<double>([&](std::size_t c) {
    const double distance = size * std::abs(static_cast<double>(slopes[c]));
    if (!system.second_order()) return distance;
    Real velocity = system.unit_mass() ? start(m + c) : Real(0);
    for (std::size_t i = 0; i < m && !system.unit_mass(); ++i) {
      velocity += system.inverse_mass(c, i) * start(m + i);
    }
    return size * (std::abs(static_cast<double>(velocity)) + distance);
  });
}

/// The largest change of a slope between two solutions, over all components and stages.
template <class Real, int Lanes>
double largest_change(const StageSlopes<Real, Lanes>& stages,
                      const std::vector<Pack<Real, Lanes>>& before,
                      const std::vector<Pack<Real, Lanes>>& after) {
  using P = Pack<Real, Lanes>;
  return static_cast<double>(largest_magnitude(
      stages.template largest_component<P>([&](std::size_t c) { return after[c] - before[c]; })));
}

}  // namespace hamjet
