#include "energy_error.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state) {
  return {state.begin(), state.end()};
}

std::variant<EnergyError::Kept, EnergyError::Changing> EnergyError::energy_of(
    const DynamicalSystem& system) {
  if (std::optional<OperationList> kept = conserved_list(system)) return Kept(std::move(*kept));
  return Changing(system.hamiltonian);
}

EnergyError::EnergyError(const DynamicalSystem& system, const std::vector<double>& start,
                         const ClockTime& start_time)
    : energy_(energy_of(system)), initial_(value(extended(start), start_time)) {}

Extended EnergyError::value(const std::vector<Extended>& state, const ClockTime& time) {
  const auto value_of = [&]<class Real>(DifferentiableFunction<Real>& energy) -> Extended {
    std::vector<Real> point;
    for (const Extended& x : state) point.push_back(convert<Real>(x));
    if (energy.has_time()) {
      energy.evaluate(point, time.in<Real>());
    } else {
      energy.evaluate(point);
    }
    return energy.value(0);
  };
  return std::visit(value_of, energy_);
}

double EnergyError::relative(const Extended& difference) const {
  return static_cast<double>(initial_ == 0 ? difference : Extended(difference / abs(initial_)));
}

double EnergyError::terms(const std::vector<Extended>& state) const {
  const auto terms_of = [&](const auto& energy) {
    double sum = std::abs(static_cast<double>(energy.value(0)));
    for (std::size_t i = 0; i < state.size(); ++i) {
      sum += std::abs(static_cast<double>(Extended(energy.derivative(0, i) * state[i])));
    }
    return sum;
  };
  return std::visit(terms_of, energy_);
}

double EnergyError::error(const std::vector<Extended>& state, const ClockTime& time) {
  return relative(value(state, time) - initial_);
}

}  // namespace hamjet
