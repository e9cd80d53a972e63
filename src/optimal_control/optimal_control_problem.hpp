#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// An optimal-control problem in continuous time over [0, T],
///
///   minimise the integral of g(x, u)  subject to  x' = f(x, u),  phi_0(x(0)) = 0,
///   phi_n(x(T)) = 0,
///
/// with n states and m controls; none of the functions depends on time. If there are fewer end
/// conditions than states, the end point is partly free, and the transversality conditions take the
/// place of the missing ones. Source: Guibout and Bloch, eqs. def_optimalpb, dyn, boundcond.
struct OptimalControlProblem {
  std::string name;
  std::size_t states = 0;
  std::size_t controls = 0;
  OperationList running_cost;        ///< g: n + m inputs (x, u), 1 output
  OperationList dynamics;            ///< f: n + m inputs (x, u), n outputs
  OperationList initial_conditions;  ///< phi_0: n inputs, at most n outputs
  OperationList final_conditions;    ///< phi_n: n inputs, at most n outputs
};

/// Running cost and dynamics as templates over their number type, functions of spans of n states
/// and m controls. They are run once, on Expressions.
template <class Functions>
concept OptimalControlFunctions = requires(const Functions& functions,
                                           std::span<const Expression> x) {
  { functions.running_cost(x, x) } -> std::convertible_to<Expression>;
  { functions.dynamics(x, x) } -> std::convertible_to<std::vector<Expression>>;
};

/// Returns the problem if its sizes fit. Otherwise throws Error(usage) that names the function, its
/// size and the right size; also for no states, no controls or 4 n + m > 60.
OptimalControlProblem checked(OptimalControlProblem problem);

/// Records a problem. `functions` gives g and f, the lists are phi_0 and phi_n; see fixed_state and
/// fixed_components. Throws what `checked` throws.
template <OptimalControlFunctions Functions>
OptimalControlProblem make_optimal_control_problem(std::string name, std::size_t states,
                                                   std::size_t controls, const Functions& functions,
                                                   OperationList initial_conditions,
                                                   OperationList final_conditions) {
  OptimalControlProblem problem;
  problem.name = std::move(name);
  problem.states = states;
  problem.controls = controls;
  problem.running_cost = record(states + controls, [&](std::span<const Expression> z) {
    return std::vector<Expression>{functions.running_cost(z.first(states), z.last(controls))};
  });
  problem.dynamics = record(states + controls, [&](std::span<const Expression> z) {
    return std::vector<Expression>(functions.dynamics(z.first(states), z.last(controls)));
  });
  problem.initial_conditions = std::move(initial_conditions);
  problem.final_conditions = std::move(final_conditions);
  return checked(std::move(problem));
}

/// The end conditions x - values = 0, which fix the end point completely.
OperationList fixed_state(std::span<const double> values);

/// The end conditions x_i - value = 0 for some of the n components, the others being free. Throws
/// Error(usage) if the numbers of components and values differ, or for a component that is not
/// there.
OperationList fixed_components(std::size_t states, std::span<const std::size_t> components,
                               std::span<const double> values);

/// The list of H(x, p, u) = g(x, u) + <p, f(x, u)>: 2n + m inputs (x, p, u), 1 output. Source:
/// Guibout and Bloch, "Maximum principle".
OperationList control_hamiltonian(const OptimalControlProblem& problem);

}  // namespace hamjet
