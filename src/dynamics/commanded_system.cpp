#include "commanded_system.hpp"

#include <utility>
#include <vector>

#include "costate_system.hpp"

namespace hamjet {

DynamicalSystem commanded_system(const DynamicalSystem& system) {
  using Places = CommandedPlaces;
  const DynamicalSystem controller = costate_system(system);
  const bool has_time = system.vector_field.has_time();
  const std::size_t inputs = Places::count + (has_time ? 1 : 0);
  const auto of_list = [](const OperationList& list, std::span<const Expression> z,
                          std::initializer_list<std::array<std::size_t, 6>> places) {
    std::vector<Expression> values;
    for (const auto& six : places) {
      for (const std::size_t place : six) values.push_back(z[place]);
    }
    if (list.has_time()) values.push_back(z.back());
    return recorded_outputs(list, values);
  };
  OperationList hamiltonian = record(
      inputs,
      [&](std::span<const Expression> z) {
        return of_list(controller.hamiltonian, z, {Places::believed, Places::costates});
      },
      has_time);
  OperationList field = record(
      inputs,
      [&](std::span<const Expression> z) {
        const std::vector<Expression> own =
            of_list(controller.vector_field, z, {Places::believed, Places::costates});
        const std::vector<Expression> carried =
            of_list(system.vector_field, z, {Places::spacecraft});
        std::vector<Expression> rates(Places::count, Expression(0));
        for (std::size_t i = 0; i < 6; ++i) {
          rates[Places::believed[i]] = own[i];
          rates[Places::costates[i]] = own[6 + i];
          rates[Places::spacecraft[i]] = carried[i];
        }
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) {
            rates[Places::spacecraft[3 + i]] -=
                z[Places::matrix + 3 * i + j] * z[Places::costates[3 + j]];
          }
        }
        return rates;
      },
      has_time);
  DynamicalSystem result = make_system("commanded thrust of " + system.name, std::move(hamiltonian),
                                       std::move(field), 9);
  // The Hamiltonian is the controller's alone.
  result.is_hamiltonian = false;
  result.waves_on_a_circle = system.waves_on_a_circle;
  result.break_times = system.break_times;
  return result;
}

}  // namespace hamjet
