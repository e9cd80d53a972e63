#include "hamjet/integrators/gauss_collocation.hpp"

#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "../integration_clock.hpp"
#include "../symmetry/symmetry_reduction.hpp"
#include "gauss_lanes.hpp"
#include "gauss_tolerance.hpp"

namespace hamjet {

namespace {

/// Up to this order the first trial of a tolerance is made with the whole jet. This takes 1.5 times
/// (order 1) to 3.4 times (order 4) as long as a trial with lines, but if the tolerance suffices
/// the jet is finished. At order 5 it would take 5.8 times as long, for a trial that often fails.
constexpr int highest_order_tried_whole = 4;

/// Integrates with the steps of a tolerance; the rotation is left out where the problem allows it.
template <class Real>
FlowJet<Real> integrate_with(const FlowProblem<Real>& problem, const GaussSettings& settings,
                             IntegrationStatistics& statistics,
                             const StepObserver<Real>& observer) {
  const auto run = [&](const FlowProblem<Real>& integrated, const StepObserver<Real>& watch) {
    return run_gauss<Real>(integrated, settings, statistics, watch);
  };
  return integrate_without_symmetry(problem, statistics, observer, run);
}

}  // namespace

template <class Real>
FlowJet<Real> integrate_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                              IntegrationStatistics& statistics,
                              const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
  validate_gauss(settings);
  GaussSettings used = settings;
  const IntegrationClock clock;
  // An observer, or a profile, must see one integration only.
  const bool is_tried_whole = needs_choice(problem, settings) && !observer &&
                              settings.profile == nullptr &&
                              problem.space->order() <= highest_order_tried_whole;
  StepTolerance<Real> choice;
  if (is_tried_whole) {
    FlowJet<Real> jet = integrate_with(problem, used, statistics, observer);
    const FirstTrial<Real> first{jet, statistics};
    choice = choose_step_tolerance(problem, settings, 1, &first);
    if (choice.tolerance == *settings.tolerance) {
      statistics.choice_seconds = clock.seconds() - statistics.wall_seconds;
      statistics.wall_seconds = clock.seconds();
      record_choice(std::move(choice), statistics);
      return jet;
    }
    statistics = {};
  } else {
    choice = choose_step_tolerance(problem, settings);
  }
  if (settings.tolerance) used.tolerance = choice.tolerance;
  const double choice_seconds = clock.seconds();
  FlowJet<Real> jet = integrate_with(problem, used, statistics, observer);
  statistics.choice_seconds = choice_seconds;
  statistics.wall_seconds += choice_seconds;
  record_choice(std::move(choice), statistics);
  return jet;
}

template FlowJet<InstantiatedReal> integrate_gauss(const FlowProblem<InstantiatedReal>&,
                                                   const GaussSettings&, IntegrationStatistics&,
                                                   const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
