#include "burning_system.hpp"

#include <utility>
#include <vector>

#include "orbit_axes.hpp"

namespace hamjet {
namespace {

/// The inputs (q, p, c, t) of a list whose states have `more` further parameters, without these.
std::vector<Expression> without_last(std::span<const Expression> inputs, std::size_t kept,
                                     bool has_time) {
  std::vector<Expression> result(inputs.begin(),
                                 inputs.begin() + static_cast<std::ptrdiff_t>(kept));
  if (has_time) result.push_back(inputs.back());
  return result;
}

/// The system whose states end with further parameters on which nothing depends yet.
DynamicalSystem with_parameters(const DynamicalSystem& system, std::size_t more) {
  const std::size_t states = system.dimension();
  const auto extended = [&](const OperationList& list, std::size_t outputs) {
    const bool has_time = list.has_time();
    return record(
        list.inputs() + more,
        [&](std::span<const Expression> z) {
          std::vector<Expression> values =
              recorded_outputs(list, without_last(z, states, has_time));
          values.resize(outputs, Expression(0));
          return values;
        },
        has_time);
  };
  DynamicalSystem result =
      make_system(system.name, extended(system.hamiltonian, 1),
                  extended(system.vector_field, states + more), system.parameters + more);
  result.waves_on_a_circle = system.waves_on_a_circle;
  result.break_times = system.break_times;
  return result;
}

}  // namespace

DynamicalSystem burning_system(const DynamicalSystem& system, const BurningThrust& thrust) {
  const std::size_t first = system.dimension();
  return with_force(
      with_parameters(system, thrust.parameters()), [&](std::span<const Expression> z) {
        const auto c = z.subspan(first, 3);
        const Expression share = thrust.mass_falls ? 1 / (z[first + 3] - z.back()) : Expression(1);
        std::vector<Expression> force;
        if (thrust.axes != ThrustAxes::inertial) {
          const auto axes = thrust.axes == ThrustAxes::rtn
                                ? orbit_axes(z.first(3), z.subspan(3, 3))
                                : velocity_axes(z.first(3), z.subspan(3, 3));
          for (std::size_t i = 0; i < 3; ++i) {
            force.push_back((c[0] * axes[0][i] + c[1] * axes[1][i] + c[2] * axes[2][i]) * share);
          }
        } else {
          for (std::size_t i = 0; i < 3; ++i) force.push_back(c[i] * share);
        }
        return force;
      });
}

}  // namespace hamjet
