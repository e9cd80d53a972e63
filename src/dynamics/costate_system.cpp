#include "costate_system.hpp"

#include <utility>
#include <vector>

#include "hamjet/error.hpp"

namespace hamjet {

Expression costates_along_field(const DynamicalSystem& system, std::span<const Expression> z) {
  const std::size_t states = system.dimension();
  std::vector<Expression> inputs(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(states));
  if (system.vector_field.has_time()) inputs.push_back(z.back());
  const std::vector<Expression> field = recorded_outputs(system.vector_field, inputs);
  Expression sum = 0;
  for (std::size_t i = 0; i < states; ++i) sum += z[states + i] * field[i];
  return sum;
}

DynamicalSystem costate_system(const DynamicalSystem& system) {
  if (system.parameters != 0) {
    throw Error(ErrorKind::usage, "costates: got a system with parameters, must be without");
  }
  const std::size_t n = system.degrees_of_freedom;
  const std::size_t states = system.dimension();
  const bool has_time = system.vector_field.has_time();
  OperationList hamiltonian = record(
      2 * states + (has_time ? 1 : 0),
      [&](std::span<const Expression> z) {
        Expression h = costates_along_field(system, z);
        for (std::size_t i = n; i < states; ++i) h -= square(z[states + i]) / 2;
        return std::vector<Expression>{h};
      },
      has_time);
  DynamicalSystem result =
      make_system("energy-optimal control of " + system.name, std::move(hamiltonian));
  result.waves_on_a_circle = system.waves_on_a_circle;
  result.break_times = system.break_times;
  // States and costates turn alike.
  if (system.rotated_planes.empty()) return result;
  return with_rotation(std::move(result), system.rotated_planes);
}

}  // namespace hamjet
