#include "optimal_control_problem.hpp"

#include <fmt/format.h>

#include <numeric>

#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Recorded functions store the dependencies of a value as bits of a 64-bit number.
constexpr std::size_t most_numbers = 60;

void require_size(const OptimalControlProblem& problem, std::string_view what, std::size_t found,
                  std::size_t right) {
  if (found == right) return;
  throw Error(ErrorKind::usage, fmt::format("optimal control problem {}: {}, got {}, must be {}",
                                            problem.name, what, found, right));
}

void require_end_conditions(const OptimalControlProblem& problem, std::string_view name,
                            const OperationList& conditions) {
  require_size(problem, fmt::format("wrong number of inputs of the {} conditions", name),
               conditions.inputs(), problem.states);
  if (conditions.outputs().size() <= problem.states) return;
  throw Error(ErrorKind::usage,
              fmt::format("optimal control problem {}: too many {} conditions, got {}, must be at "
                          "most {}, one a state",
                          problem.name, name, conditions.outputs().size(), problem.states));
}

}  // namespace

OptimalControlProblem checked(OptimalControlProblem problem) {
  const std::size_t n = problem.states;
  const std::size_t m = problem.controls;
  if (n == 0 || m == 0 || 4 * n + m > most_numbers) {
    throw Error(ErrorKind::usage,
                fmt::format("optimal control problem {}: wrong size, got {} states and {} "
                            "controls, must be at least one each with 4 states + controls <= {}",
                            problem.name, n, m, most_numbers));
  }
  require_size(problem, "wrong number of inputs of the running cost", problem.running_cost.inputs(),
               n + m);
  require_size(problem, "wrong number of values of the running cost",
               problem.running_cost.outputs().size(), 1);
  require_size(problem, "wrong number of inputs of the dynamics", problem.dynamics.inputs(), n + m);
  require_size(problem, "wrong number of values of the dynamics", problem.dynamics.outputs().size(),
               n);
  require_end_conditions(problem, "initial", problem.initial_conditions);
  require_end_conditions(problem, "final", problem.final_conditions);
  return problem;
}

OperationList fixed_state(std::span<const double> values) {
  std::vector<std::size_t> components(values.size());
  std::iota(components.begin(), components.end(), std::size_t{0});
  return fixed_components(values.size(), components, values);
}

OperationList fixed_components(std::size_t states, std::span<const std::size_t> components,
                               std::span<const double> values) {
  if (components.size() != values.size()) {
    throw Error(ErrorKind::usage, fmt::format("end conditions: wrong number of values, got {}, "
                                              "must be {}, one a fixed component",
                                              values.size(), components.size()));
  }
  return record(states, [&](std::span<const Expression> x) {
    std::vector<Expression> conditions;
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (components[i] >= states) {
        throw Error(ErrorKind::usage, fmt::format("end conditions: no component {}, must be below "
                                                  "{}",
                                                  components[i], states));
      }
      conditions.push_back(x[components[i]] - values[i]);
    }
    return conditions;
  });
}

OperationList control_hamiltonian(const OptimalControlProblem& problem) {
  const std::size_t n = problem.states;
  const std::size_t m = problem.controls;
  return record(2 * n + m, [&](std::span<const Expression> z) {
    std::vector<Expression> arguments(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
    arguments.insert(arguments.end(), z.end() - static_cast<std::ptrdiff_t>(m), z.end());
    Expression sum = recorded_outputs(problem.running_cost, arguments)[0];
    const std::vector<Expression> f = recorded_outputs(problem.dynamics, arguments);
    for (std::size_t i = 0; i < n; ++i) sum += z[n + i] * f[i];
    return std::vector<Expression>{sum};
  });
}

}  // namespace hamjet
