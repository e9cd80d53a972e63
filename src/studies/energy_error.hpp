#pragma once

#include <variant>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state);

/// Energies in extended precision, and their changes relative to the energy at the start (absolute
/// where that is 0). The energy is the quantity that the system keeps, of which changes are errors;
/// of a system that keeps none (DynamicalSystem::conserved_quantity) it is the Hamiltonian, whose
/// changes are no errors, so that it is evaluated in double precision. All times are those of the
/// system's clock.
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
  using Kept = DifferentiableFunction<Extended>;
  using Changing = DifferentiableFunction<double>;
  static std::variant<Kept, Changing> energy_of(const DynamicalSystem& system);

  std::variant<Kept, Changing> energy_;
  Extended initial_ = 0;
};

}  // namespace hamjet
