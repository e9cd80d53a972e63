#include "thrusting_system.hpp"

#include <utility>
#include <vector>

#include "costate_system.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

DynamicalSystem thrusting_system(const DynamicalSystem& system, ThrustForm form) {
  if (system.parameters != 0) {
    throw Error(ErrorKind::usage, "thrust: got a system with parameters, must be without");
  }
  const std::size_t n = system.degrees_of_freedom;
  const std::size_t states = system.dimension();
  const std::size_t parameters = form == ThrustForm::linear ? 1 : 2;
  const bool has_time = system.vector_field.has_time();
  OperationList hamiltonian = record(
      2 * states + parameters + (has_time ? 1 : 0),
      [&](std::span<const Expression> z) {
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
