#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "../real_number.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "stage_system.hpp"

// Measures by which Newton's method for the stages of a step detects round-off. The stages are the
// constant terms of the evaluator's inputs.

namespace hamjet {

/// The factor by which rounding is amplified in the stages: by the rounding of the slopes through
/// K, and by that of Y = base + W G where both terms nearly cancel (stiff systems). It is (|base| +
/// sum of |K| |G|) / |Y|, and at least 1.
template <class Real, int Lanes, class State>
Real rounding_amplification(const StageSystem<Real, Lanes>& system,
                            const SliceEvaluator<Pack<Real, Lanes>, Real>& evaluator,
                            const std::vector<Pack<Real, Lanes>>& slopes, const State& state) {
  Real result = 1;
  for (std::size_t c = 0; c < system.components(); ++c) {
    const Pack<Real, Lanes> base = system.base(c, state);
    Real scale = 0;
    Real largest = 0;
    for (int i = 0; i < static_cast<int>(system.stages()); ++i) {
      Real sum = magnitude(base.lane(i));
      for (std::size_t from = 0; from < system.components(); ++from) {
        for (std::size_t j = 0; j < system.stages(); ++j) {
          sum += magnitude(
              Real(system.response(from, j, c).lane(i) * slopes[from].lane(static_cast<int>(j))));
        }
      }
      largest = std::max(largest, sum);
      scale = std::max(scale, magnitude(evaluator.input(c)[0].lane(i)));
    }
    if (scale > 0) result = std::max(result, Real(largest / scale));
  }
  return result;
}

/// Largest change of a stage relative to the largest stage value of the same component.
template <class Real, int Lanes>
Real largest_relative_change(const StageSystem<Real, Lanes>& system,
                             const SliceEvaluator<Pack<Real, Lanes>, Real>& evaluator,
                             const std::vector<Pack<Real, Lanes>>& change) {
  Real result = 0;
  for (std::size_t c = 0; c < change.size(); ++c) {
    Real largest = 0;
    Real scale = 0;
    for (int i = 0; i < static_cast<int>(system.stages()); ++i) {
      const Real moved = magnitude(change[c].lane(i));
      if (!is_finite(moved)) return moved;
      largest = std::max(largest, moved);
      scale = std::max(scale, magnitude(evaluator.input(c)[0].lane(i)));
    }
    if (largest > 0) result = std::max(result, Real(largest / std::max(scale, largest)));
  }
  return result;
}

}  // namespace hamjet
