#pragma once

#include <cmath>
#include <vector>

#include "optimal_control/discrete_maximum_principle.hpp"
#include "optimal_control/double_integrator.hpp"
#include "optimal_control/heisenberg_problem.hpp"
#include "optimal_control/two_point_boundary_value.hpp"

namespace hamjet::test {

inline constexpr Discretization both_forms[] = {Discretization::stormer, Discretization::midpoint};

inline OptimalControlProblem heisenberg(const std::vector<double>& start,
                                        const std::vector<double>& end) {
  return make_optimal_control_problem("heisenberg", 3, 2, HeisenbergFunctions{}, fixed_state(start),
                                      fixed_state(end));
}

/// A problem as a user writes it, with little that is linear in it: a pendulum with a cost that is
/// not quadratic in the control, so that the stationarity has to be solved by iteration.
struct PendulumFunctions {
  template <class T>
  T running_cost(std::span<const T> x, std::span<const T> u) const {
    const T square = u[0] * u[0];
    return square / T(2) + square * square / T(4) + T(1) - cos(x[0]);
  }
  template <class T>
  std::vector<T> dynamics(std::span<const T> x, std::span<const T> u) const {
    return {x[1], u[0] - sin(x[0]) * (T(1) + x[1] * x[1])};
  }
};

inline OptimalControlProblem pendulum(const std::vector<double>& start,
                                      const std::vector<double>& end) {
  return make_optimal_control_problem("pendulum", 2, 1, PendulumFunctions{}, fixed_state(start),
                                      fixed_state(end));
}

inline OptimalControlProblem double_integrator(OperationList initial_conditions,
                                               OperationList final_conditions) {
  return make_optimal_control_problem("double-integrator", 2, 1, DoubleIntegratorFunctions{},
                                      std::move(initial_conditions), std::move(final_conditions));
}

/// Element by element: g++ 12 warns of its own AVX-512 header for a mapped vector of known size.
inline Eigen::VectorXd vector_of(const std::vector<double>& values) {
  Eigen::VectorXd result(Eigen::Index(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result(Eigen::Index(i)) = values[i];
  return result;
}

inline ShootingSettings shooting(const OptimalControlProblem& problem, std::size_t steps,
                                 std::size_t intervals, const std::vector<double>& state,
                                 const std::vector<double>& costate) {
  ShootingSettings settings;
  settings.steps = steps;
  settings.intervals = intervals;
  settings.state_guess = vector_of(state);
  settings.costate_guess = vector_of(costate);
  settings.control_guess = Eigen::VectorXd::Zero(Eigen::Index(problem.controls));
  return settings;
}

struct Solved {
  ShootingSolution solution;
  double cost = 0;
};

/// Solves the problem by the discrete maximum principle.
inline Solved solve(const OptimalControlProblem& problem, Discretization form, double duration,
                    const ShootingSettings& settings) {
  const double step = duration / static_cast<double>(settings.steps);
  DiscreteMaximumPrinciple map(problem, form, step);
  Solved solved{solve_by_shooting(map, problem, settings), 0};
  solved.cost = discrete_cost(problem, form, step, solved.solution.trajectory);
  return solved;
}

/// The classical Heisenberg problem from the origin to (0, 0, lift), from a guess that turns by 6
/// radians: the necessary conditions hold for circles of two turns too, and Newton finds what is
/// near.
inline Solved solve_loop(Discretization form, double lift, double duration, std::size_t steps,
                         std::size_t intervals = 1) {
  const auto problem = heisenberg({0, 0, 0}, {0, 0, lift});
  const double size = std::sqrt(std::abs(lift)) / duration;
  ShootingSettings settings = shooting(problem, steps, intervals, {0, 0, 0},
                                       {-size, 0, -std::copysign(3 / duration, lift)});
  settings.typical_state = vector_of({size * duration, size * duration, std::abs(lift)});
  settings.typical_costate = vector_of({size, size, 1 / duration});
  return solve(problem, form, duration, settings);
}

}  // namespace hamjet::test
