#include "followed_nominal.hpp"

#include "../integration.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

void follow_nominal(
    const ComputedProblem& problem, const std::vector<double>& times, double tolerance,
    const std::function<void(std::size_t index, const std::vector<Extended>& state)>& visit,
    const std::function<void(double time)>& on_step) {
  FlowProblem<Extended> flow = flow_problem<Extended>(problem, 0);
  flow.space = SeriesSpace::create(problem.variables.size(), 0);  // the nominal alone
  GaussSettings gauss;
  gauss.stages = 16;
  gauss.tolerance = tolerance;
  Extended reached = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    flow.duration = Extended(times[k]) - reached;
    IntegrationStatistics statistics;
    const FlowJet<Extended> nominal = integrate_gauss<Extended>(
        flow, gauss, statistics, [&](const Extended& since, const FlowJet<Extended>&) {
          if (on_step) on_step(static_cast<double>(Extended(reached + since)));
        });
    for (std::size_t i = 0; i < nominal.size(); ++i) flow.initial_state[i] = nominal[i][0];
    reached = Extended(times[k]);
    flow.start_time = problem.start_time + reached;
    visit(k, flow.initial_state);
  }
}

}  // namespace hamjet
