#include "hamjet/integrators/gauss_collocation.hpp"

#include <fmt/format.h>

#include <utility>

#include "gauss_lanes.hpp"
#include "gauss_tolerance.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

void validate_gauss(const GaussSettings& settings) {
  if (settings.stages < 1 || settings.stages > 16) {
    throw Error(ErrorKind::usage,
                fmt::format("Gauss: {} stages, allowed are 1..16", settings.stages));
  }
  if (settings.step.has_value() == settings.tolerance.has_value()) {
    throw Error(ErrorKind::usage, "Gauss: exactly one of step and tolerance must be given");
  }
  if (!(settings.step.value_or(1) > 0) || !(settings.tolerance.value_or(0.5) > 0) ||
      !(settings.tolerance.value_or(0.5) < 1)) {
    throw Error(ErrorKind::usage,
                "Gauss: the step must be positive, the tolerance between 0 and 1");
  }
}

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
  FlowJet<Real> jet =
      with_lanes(settings.stages, [&]<int Lanes>(std::integral_constant<int, Lanes>) {
        return run_gauss<Lanes>(problem, used, statistics, observer);
      });
  record_choice(std::move(choice), statistics);
  return jet;
}

template FlowJet<double> integrate_gauss(const FlowProblem<double>&, const GaussSettings&,
                                         IntegrationStatistics&, const StepObserver<double>&);
template FlowJet<Extended> integrate_gauss(const FlowProblem<Extended>&, const GaussSettings&,
                                           IntegrationStatistics&, const StepObserver<Extended>&);

}  // namespace hamjet
