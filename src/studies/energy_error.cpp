#include "energy_error.hpp"

#include <cmath>

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state) {
  return {state.begin(), state.end()};
}

namespace {

template <class Function>
void evaluate_at(Function& function, const std::vector<Extended>& state, const ClockTime& time) {
  if constexpr (requires { function.has_time(); }) {
    if (function.has_time()) return function.evaluate(state, time.in<Extended>());
  }
  function.evaluate(state);
}

}  // namespace

EnergyError::EnergyError(const DynamicalSystem& system, const std::vector<double>& start,
                         const ClockTime& start_time)
    : hamiltonian_(system.hamiltonian), initial_(value(extended(start), start_time)) {}

Extended EnergyError::value(const std::vector<Extended>& state, const ClockTime& time) {
  evaluate_at(hamiltonian_, state, time);
  return hamiltonian_.value(0);
}

double EnergyError::relative(const Extended& difference) const {
  return static_cast<double>(initial_ == 0 ? difference : Extended(difference / abs(initial_)));
}

double EnergyError::terms(const std::vector<Extended>& state) const {
  double sum = std::abs(static_cast<double>(hamiltonian_.value(0)));
  for (std::size_t i = 0; i < state.size(); ++i) {
    sum += std::abs(static_cast<double>(Extended(hamiltonian_.derivative(0, i) * state[i])));
  }
  return sum;
}

double EnergyError::error(const std::vector<Extended>& state, const ClockTime& time) {
  return relative(value(state, time) - initial_);
}

}  // namespace hamjet
