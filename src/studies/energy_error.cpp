#include "energy_error.hpp"

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state) {
  return {state.begin(), state.end()};
}

EnergyError::EnergyError(const DynamicalSystem& system, const std::vector<double>& start)
    : hamiltonian_(system.hamiltonian), initial_(value(extended(start))) {}

Extended EnergyError::value(const std::vector<Extended>& state) {
  hamiltonian_.evaluate(state);
  return hamiltonian_.value(0);
}

double EnergyError::relative(const Extended& difference) const {
  return static_cast<double>(initial_ == 0 ? difference : Extended(difference / abs(initial_)));
}

double EnergyError::error(const std::vector<Extended>& state) {
  return relative(value(state) - initial_);
}

}  // namespace hamjet
