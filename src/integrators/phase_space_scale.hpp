#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The linearised motion about one state: the largest entries of dq'/dp and dp'/dq.
struct LinearisedMotion {
  double velocity_gradient = 0;
  double force_gradient = 0;

  /// The frequency of the oscillation that such entries make, in radians a unit of time.
  double frequency() const { return std::sqrt(velocity_gradient * force_gradient); }
};

template <class Real>
LinearisedMotion linearised_motion(const DynamicalSystem& system, std::span<const Real> state) {
  const std::size_t n = system.degrees_of_freedom;
  SliceEvaluator<Real, Real> field(system.vector_field, SeriesSpace::create(1, 0), 0);
  for (std::size_t i = 0; i < state.size(); ++i) *field.input(i) = state[i];
  field.evaluate_constant_terms();
  LinearisedMotion result;
  const auto include = [&](double& largest, std::size_t i, std::size_t j) {
    largest = std::max(largest, std::abs(static_cast<double>(field.output_gradient(i, j))));
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      include(result.velocity_gradient, i, n + j);
      include(result.force_gradient, n + i, j);
    }
  }
  return result;
}

/// How large a deviation of the momenta does as much as a unit deviation of the positions, at one
/// state: a number P by which momenta are divided before they are compared with positions. It is
///
///   P = max( sqrt(|dp'/dq| / |dq'/dp|) , |p| / |q| ) ,
///
/// the ratio of the axes of the linearised motion, or that of the motion itself where that is
/// faster (a flight past a centre). A change of the units of length, mass and time changes P as it
/// changes p / q, so that nothing that is decided in scaled variables depends on them. 1 where both
/// terms are undefined (a state at rest in the origin of a system without forces).
template <class Real>
double momentum_scale(const DynamicalSystem& system, std::span<const Real> state) {
  const std::size_t n = system.degrees_of_freedom;
  const LinearisedMotion motion = linearised_motion(system, state);
  double position = 0;
  double momentum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    position = std::max(position, std::abs(static_cast<double>(state[i])));
    momentum = std::max(momentum, std::abs(static_cast<double>(state[n + i])));
  }
  double scale = 0;
  if (motion.velocity_gradient > 0) {
    scale = std::sqrt(motion.force_gradient / motion.velocity_gradient);
  }
  if (position > 0) scale = std::max(scale, momentum / position);
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

}  // namespace hamjet
