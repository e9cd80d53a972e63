#include "fixed_step_trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "../energy_error.hpp"
#include "../exact_flow.hpp"
#include "../thinned_list.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"

namespace hamjet {

FixedStepTrajectory fixed_step_trajectory(const DynamicalSystem& system,
                                          EnergyConservingMethod method,
                                          const std::vector<double>& start, double step, double end,
                                          const ProgressCallback& progress) {
  constexpr double most_steps = 1e6;
  const bool is_verlet = method == EnergyConservingMethod::stormer;
  FixedStepTrajectory result;
  result.method = is_verlet ? "velocity Verlet" : "midpoint rule";
  result.step = step;
  const double duration = std::clamp(end, -most_steps * step, most_steps * step);
  const FlowProblem<double> problem =
      trajectory_problem(system, start, ClockTime::epoch(), duration);
  EnergyError energy(system, start, ClockTime::epoch());
  ThinnedList<std::pair<double, double>> errors;
  errors.add({0, 0});
  std::vector<Extended> state(start.size());
  const StepObserver<double> observe = [&](const double& time, const FlowJet<double>& jet) {
    if (progress) progress("fixed-step trajectory", time / duration);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] = jet[i][0];
    const double error = energy.error(state, ClockTime(time));
    result.largest_energy_error = std::max(result.largest_energy_error, std::abs(error));
    ++result.steps;
    errors.add({time, error});
  };
  IntegrationStatistics statistics;
  try {
    if (is_verlet) {
      integrate_velocity_verlet(problem, {.step = step}, statistics, observe);
    } else {
      GaussSettings settings;
      settings.stages = 1;
      settings.step = step;
      integrate_gauss(problem, settings, statistics, observe);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.failure = error.what();
  }
  result.energy_errors = errors.take();
  return result;
}

}  // namespace hamjet
