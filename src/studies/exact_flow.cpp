#include "exact_flow.hpp"

#include <numeric>

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

FlowJet<double> linear_jet(const SharedSystem& system, const std::vector<double>& start,
                           const ClockTime& start_time, double duration, double tolerance) {
  GaussSettings settings;
  settings.tolerance = tolerance;
  IntegrationStatistics statistics;
  const SpacePointer space = SeriesSpace::create(start.size(), 1);
  return integrate_gauss<double>(linear_problem(system, space, start, start_time, duration),
                                 settings, statistics);
}

GaussSettings exact_gauss() {
  GaussSettings settings;
  settings.tolerance = 1e-13;
  return settings;
}

std::vector<double> exact_flow(const SharedSystem& system, const std::vector<double>& start,
                               const ClockTime& start_time, double duration) {
  IntegrationStatistics statistics;
  return nominal_of(integrate_gauss(trajectory_problem(system, start, start_time, duration),
                                    exact_gauss(), statistics));
}

}  // namespace hamjet
