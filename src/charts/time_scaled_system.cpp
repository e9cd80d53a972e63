#include "time_scaled_system.hpp"

#include <span>
#include <vector>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr std::size_t n = 3;

std::vector<Expression> without_scale(std::span<const Expression> z) {
  return {z[0], z[1], z[2], z[4], z[5], z[6]};
}

OperationList energy_of(const DynamicalSystem& system) {
  return record(2 * n + 2, [&](std::span<const Expression> z) {
    return recorded_outputs(system.hamiltonian, without_scale(z));
  });
}

/// At a pace of its own an orbit would meet forces of another time.
void require_autonomous(const DynamicalSystem& system) {
  if (system.is_autonomous()) return;
  throw Error(ErrorKind::usage,
              "flow at another pace: the system depends on the time, must be one whose flow is the "
              "same at every start");
}

}  // namespace

DynamicalSystem time_scaled(const DynamicalSystem& system) {
  require_autonomous(system);
  if (system.degrees_of_freedom != n || !system.second_order) {
    throw Error(ErrorKind::usage, "flow box: the system must be that of an orbit");
  }
  OperationList field = record(2 * n + 2, [&](std::span<const Expression> z) {
    const std::vector<Expression> force = recorded_outputs(system.second_order->force, z.first(n));
    const Expression factor = Expression(1) + z[n] * Expression(1 / scale_parameter_unit);
    std::vector<Expression> result(z.begin() + n + 1, z.end());
    for (const Expression& f : force) result.push_back(factor * f);
    result.emplace_back(0);
    return result;
  });
  DynamicalSystem scaled = make_system(system.name, energy_of(system), std::move(field));
  scaled.waves_on_a_circle = system.waves_on_a_circle;
  return scaled;
}

DynamicalSystem time_scaled_first_order(const DynamicalSystem& system) {
  require_autonomous(system);
  OperationList field = record(2 * n + 2, [&](std::span<const Expression> z) {
    const std::vector<Expression> slopes = recorded_outputs(system.vector_field, without_scale(z));
    std::vector<Expression> result;
    for (std::size_t i = 0; i < n; ++i) result.push_back(z[n] * slopes[i]);
    result.emplace_back(0);
    for (std::size_t i = n; i < 2 * n; ++i) result.push_back(z[n] * slopes[i]);
    result.emplace_back(0);
    return result;
  });
  return make_system(system.name, energy_of(system), std::move(field));
}

}  // namespace hamjet
