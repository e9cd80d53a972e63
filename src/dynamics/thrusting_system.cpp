#include "thrusting_system.hpp"

#include <utility>
#include <vector>

#include "costate_system.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

namespace {

/// The Hamiltonian of a thrust by falling mass; z is (x, w, lambda, lambda_w, a, k), and the time.
Expression with_falling_mass(const DynamicalSystem& system, std::span<const Expression> z) {
  const std::size_t n = system.degrees_of_freedom;
  const std::size_t states = system.dimension();
  const std::size_t costates = states + 1;
  std::vector<Expression> known(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(states));
  for (std::size_t i = 0; i < states; ++i) known.push_back(z[costates + i]);
  if (system.vector_field.has_time()) known.push_back(z.back());
  Expression primer_squared = 0;
  for (std::size_t i = n; i < states; ++i) primer_squared += square(z[costates + i]);
  const Expression& change = z[states];
  const Expression& change_costate = z[costates + states];
  const Expression& first_acceleration = z[2 * costates];
  const Expression& inverse_exhaust = z[2 * costates + 1];
  return costates_along_field(system, known) + first_acceleration * exp(change * inverse_exhaust) *
                                                   (change_costate - sqrt(primer_squared));
}

}  // namespace

DynamicalSystem thrusting_system(const DynamicalSystem& system, ThrustForm form) {
  if (system.parameters != 0) {
    throw Error(ErrorKind::usage, "thrust: got a system with parameters, must be without");
  }
  const std::size_t n = system.degrees_of_freedom;
  const std::size_t states = system.dimension();
  const std::size_t parameters = form == ThrustForm::linear ? 1 : 2;
  const bool has_time = system.vector_field.has_time();
  const std::size_t positions = form == ThrustForm::falling ? states + 1 : states;
  OperationList hamiltonian = record(
      2 * positions + parameters + (has_time ? 1 : 0),
      [&](std::span<const Expression> z) {
        if (form == ThrustForm::falling) {
          return std::vector<Expression>{with_falling_mass(system, z)};
        }
        Expression h = costates_along_field(system, z);
        Expression primer_squared = 0;
        for (std::size_t i = n; i < states; ++i) primer_squared += square(z[states + i]);
        h -= z[2 * states] * primer_squared / 2;
        if (form == ThrustForm::directed) h += z[2 * states + 1] * sqrt(primer_squared);
        return std::vector<Expression>{h};
      },
      has_time);
  DynamicalSystem result =
      make_system("thrust of " + system.name, std::move(hamiltonian), std::nullopt, parameters);
  result.waves_on_a_circle = system.waves_on_a_circle;
  result.break_times = system.break_times;
  return result;
}

}  // namespace hamjet
