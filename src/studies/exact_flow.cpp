#include "exact_flow.hpp"

#include <numeric>

#include "../integrators/gauss/gauss_tolerance.hpp"

namespace hamjet {

std::vector<double> nominal_of(const FlowJet<double>& jet) {
  std::vector<double> state;
  for (const Series<double>& component : jet) state.push_back(component[0]);
  return state;
}

FlowProblem<double> trajectory_problem(const SharedSystem& system, const std::vector<double>& start,
                                       const ClockTime& start_time, double duration) {
  return {system, SeriesSpace::create(1, 0), {0}, start, start_time, duration};
}

FlowProblem<double> linear_problem(const SharedSystem& system, const SpacePointer& space,
                                   const std::vector<double>& start, const ClockTime& start_time,
                                   double duration) {
  std::vector<std::size_t> variables(start.size());
  std::iota(variables.begin(), variables.end(), std::size_t{0});
  FlowProblem<double> flow{system, space, variables, start, start_time, duration};
  flow.symmetry = FlowSymmetry::none;
  return flow;
}

namespace {

FlowJet<double> with_steps(const FlowProblem<double>& problem, const GaussSettings& settings) {
  validate(problem);
  IntegrationStatistics statistics;
  return integrate_with_step_tolerance(problem, settings, *settings.tolerance, statistics);
}

}  // namespace

FlowJet<double> linear_jet(const SharedSystem& system, const std::vector<double>& start,
                           const ClockTime& start_time, double duration, double tolerance) {
  GaussSettings settings;
  settings.tolerance = tolerance;
  const SpacePointer space = SeriesSpace::create(start.size(), 1);
  return with_steps(linear_problem(system, space, start, start_time, duration), settings);
}

std::vector<double> exact_flow(const SharedSystem& system, const std::vector<double>& start,
                               const ClockTime& start_time, double duration) {
  // Steps whose errors are far below rounding are a fifth more than those of a jet's tolerance, and
  // need no trial of it where the field has short waves.
  GaussSettings settings;
  settings.tolerance = 1e-17;
  settings.compensated_summation = true;
  return nominal_of(with_steps(trajectory_problem(system, start, start_time, duration), settings));
}

}  // namespace hamjet
