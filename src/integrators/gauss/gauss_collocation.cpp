#include "hamjet/integrators/gauss_collocation.hpp"

#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "../rotation_reduction.hpp"
#include "gauss_lanes.hpp"
#include "gauss_tolerance.hpp"

namespace hamjet {

template <class Real>
FlowJet<Real> integrate_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                              IntegrationStatistics& statistics,
                              const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
  validate_gauss(settings);
  GaussSettings used = settings;
  StepTolerance<Real> choice = choose_step_tolerance(problem, settings);
  if (settings.tolerance) used.tolerance = choice.tolerance;
  const auto run = [&](const FlowProblem<Real>& integrated, const StepObserver<Real>& watch) {
    return with_lanes(settings.stages, [&]<int Lanes>(std::integral_constant<int, Lanes>) {
      return run_gauss<Lanes>(integrated, used, statistics, watch);
    });
  };
  FlowJet<Real> jet = integrate_without_rotation(problem, statistics, observer, run);
  record_choice(std::move(choice), statistics);
  return jet;
}

template FlowJet<InstantiatedReal> integrate_gauss(const FlowProblem<InstantiatedReal>&,
                                                   const GaussSettings&, IntegrationStatistics&,
                                                   const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
