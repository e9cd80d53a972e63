#pragma once

#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state);

/// Energies in extended precision, and their changes relative to the energy at the start (absolute
/// where that is 0). The changes are errors where the system keeps its energy. All times are those
/// of the system's clock.
class EnergyError {
 public:
  EnergyError(const DynamicalSystem& system, const std::vector<double>& start,
              const ClockTime& start_time);

  Extended value(const std::vector<Extended>& state, const ClockTime& time);
  double relative(const Extended& difference) const;
  double error(const std::vector<Extended>& state, const ClockTime& time);
  const Extended& initial() const { return initial_; }
  /// |H| + sum |z_i dH/dz_i| at the state z, the last one given to `value`: the size of the terms
  /// that H is made of.
  double terms(const std::vector<Extended>& state) const;

 private:
  DifferentiableFunction<Extended> hamiltonian_;
  Extended initial_ = 0;
};

}  // namespace hamjet
