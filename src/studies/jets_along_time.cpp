#include "jets_along_time.hpp"

#include "exact_flow.hpp"
#include "integration.hpp"

namespace hamjet {

IntegrationStatistics visit_jets(
    const ComputedProblem& problem, const IntegratorSettings& settings,
    std::span<const double> times,
    const std::function<void(std::size_t index, const FlowJet<double>& jet)>& visit) {
  IntegrationStatistics total;
  FlowProblem<double> flow = flow_problem<double>(problem, 0);
  flow.initial_jet = starting_jet(flow);
  double reached = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    flow.duration = times[i] - reached;
    flow.initial_state = nominal_of(*flow.initial_jet);
    IntegrationStatistics statistics;
    flow.initial_jet = integrate<double>(flow, settings, statistics, {});
    total.steps += statistics.steps;
    total.rejected_steps += statistics.rejected_steps;
    total.vector_field_evaluations += statistics.vector_field_evaluations;
    total.nominal_evaluations += statistics.nominal_evaluations;
    total.wall_seconds += statistics.wall_seconds;
    reached = times[i];
    visit(i, *flow.initial_jet);
  }
  return total;
}

}  // namespace hamjet
