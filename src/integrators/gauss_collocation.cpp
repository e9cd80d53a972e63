#include "hamjet/integrators/gauss_collocation.hpp"

#include <fmt/format.h>

#include "gauss_lanes.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

template <class Real>
FlowJet<Real> integrate_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                              IntegrationStatistics& statistics,
                              const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
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
  // The stages fill the lanes of a pack; the smallest of five widths that holds them is taken.
  if (settings.stages == 1) return run_gauss<1>(problem, settings, statistics, observer);
  if (settings.stages == 2) return run_gauss<2>(problem, settings, statistics, observer);
  if (settings.stages <= 4) return run_gauss<4>(problem, settings, statistics, observer);
  if (settings.stages <= 8) return run_gauss<8>(problem, settings, statistics, observer);
  return run_gauss<16>(problem, settings, statistics, observer);
}

template FlowJet<double> integrate_gauss(const FlowProblem<double>&, const GaussSettings&,
                                         IntegrationStatistics&, const StepObserver<double>&);
template FlowJet<Extended> integrate_gauss(const FlowProblem<Extended>&, const GaussSettings&,
                                           IntegrationStatistics&, const StepObserver<Extended>&);

}  // namespace hamjet
