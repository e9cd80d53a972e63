#pragma once

#include <algorithm>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The Hamiltonian of a state that is a series.
template <class Real>
Series<Real> energy_series(const DynamicalSystem& system, const SixNumbers<Series<Real>>& state) {
  const SpacePointer& space = state[0].space_pointer();
  SliceEvaluator<Real, Real> h(system.hamiltonian, space, space->order());
  for (std::size_t i = 0; i < 6; ++i) {
    std::copy_n(state[i].coefficients().data(), space->size(), h.input(i));
  }
  h.evaluate_all();
  return {space, std::vector<Real>(h.output(0), h.output(0) + space->size())};
}

}  // namespace hamjet
