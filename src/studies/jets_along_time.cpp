#include "jets_along_time.hpp"

#include <utility>

#include "../integrators/statistics_sum.hpp"
#include "../integrators/symmetry/symmetry_reduction.hpp"
#include "descriptions/method_description.hpp"
#include "exact_flow.hpp"
#include "integration.hpp"

namespace hamjet {

JetPropagation::JetPropagation(const ComputedProblem& problem, const IntegratorSettings& settings)
    : settings_(&settings),
      start_time_(problem.start_time),
      flow_(flow_problem<double>(problem, 0)) {
  if (description_of(settings.method).splittable(settings)) {
    // A symmetry is left out for any duration except zero.
    FlowProblem<double> moving = flow_;
    moving.duration = 1;
    if (auto reduction = SymmetryReduction<double>::of(moving)) {
      reduction_ = std::make_shared<const SymmetryReduction<double>>(std::move(*reduction));
      flow_ = reduction_->problem();
    }
  }
  if (!flow_.initial_jet) flow_.initial_jet = starting_jet(flow_);
}

FlowJet<double> JetPropagation::advance_to(double time) {
  flow_.duration = time - reached_;
  flow_.initial_state = nominal_of(*flow_.initial_jet);
  IntegrationStatistics statistics;
  flow_.initial_jet = integrate<double>(flow_, *settings_, statistics, {});
  add_integration(total_, statistics);
  flow_.start_time = start_time_ + time;
  reached_ = time;
  return reduction_ ? reduction_->expand(*flow_.initial_jet) : *flow_.initial_jet;
}

IntegrationStatistics visit_jets(
    const ComputedProblem& problem, const IntegratorSettings& settings,
    std::span<const double> times,
    const std::function<void(std::size_t index, const FlowJet<double>& jet)>& visit) {
  JetPropagation propagation(problem, settings);
  for (std::size_t i = 0; i < times.size(); ++i) visit(i, propagation.advance_to(times[i]));
  return propagation.statistics();
}

}  // namespace hamjet
