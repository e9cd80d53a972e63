#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The linearised motion about one state: the largest entries of dq'/dp and dp'/dq.
struct LinearisedMotion {
  double velocity_gradient = 0;
  double force_gradient = 0;

  /// The frequency, in radians per unit of time, of an oscillation with these entries.
  double frequency() const { return std::sqrt(velocity_gradient * force_gradient); }
};

/// Properties of a system at single states, with work space that is made once, so that each thread
/// needs an object of its own. The object refers to the system.
template <class Real>
class FieldAtStates {
 public:
  explicit FieldAtStates(const DynamicalSystem& system)
      : degrees_of_freedom_(system.degrees_of_freedom),
        energy_(system.hamiltonian, SeriesSpace::create(1, 0), 0),
        field_(system.vector_field, SeriesSpace::create(1, 0), 0) {}

  /// The gradient of the Hamiltonian at a state and a time of the system's clock.
  std::vector<double> energy_gradient(std::span<const Real> state, const ClockTime& time) {
    if (energy_.has_time()) energy_.set_time(time.in<Real>());
    for (std::size_t i = 0; i < state.size(); ++i) *energy_.input(i) = state[i];
    energy_.evaluate_constant_terms();
    std::vector<double> result;
    for (std::size_t i = 0; i < state.size(); ++i) {
      result.push_back(static_cast<double>(energy_.output_gradient(0, i)));
    }
    return result;
  }

  LinearisedMotion linearised_motion(std::span<const Real> state, const ClockTime& time) {
    const std::size_t n = degrees_of_freedom_;
    if (field_.has_time()) field_.set_time(time.in<Real>());
    for (std::size_t i = 0; i < state.size(); ++i) *field_.input(i) = state[i];
    field_.evaluate_constant_terms();
    LinearisedMotion result;
    const auto include = [&](double& largest, std::size_t i, std::size_t j) {
      largest = std::max(largest, std::abs(static_cast<double>(field_.output_gradient(i, j))));
    };
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        include(result.velocity_gradient, i, n + j);
        include(result.force_gradient, n + i, j);
      }
    }
    return result;
  }

  /// The deviation P of the momenta that has as much effect as a unit deviation of the positions,
  /// at one state. Momenta are divided by P before they are compared with positions. It is
  ///
  ///   P = max( sqrt(|dp'/dq| / |dq'/dp|) , |p| / |q| ) ,
  ///
  /// which is the ratio of the axes of the linearised motion or, where it is larger (in a flight
  /// past a centre), that of the motion itself. A change of units changes P as it changes p / q, so
  /// that no decision in scaled variables depends on the units. P is 1 where both terms are
  /// undefined (a state at rest in the origin of a system without forces).
  double momentum_scale(std::span<const Real> state, const ClockTime& time) {
    const std::size_t n = degrees_of_freedom_;
    const LinearisedMotion motion = linearised_motion(state, time);
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

 private:
  std::size_t degrees_of_freedom_;
  SliceEvaluator<Real, Real> energy_;
  SliceEvaluator<Real, Real> field_;
};

/// FieldAtStates::momentum_scale for one state.
template <class Real>
double momentum_scale(const DynamicalSystem& system, std::span<const Real> state,
                      const ClockTime& time) {
  return FieldAtStates<Real>(system).momentum_scale(state, time);
}

}  // namespace hamjet
