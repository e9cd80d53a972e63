#include "hamjet/integrators/newmark.hpp"

#include <fmt/format.h>

#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"
#include "newmark_force.hpp"
#include "splitting_integration.hpp"

namespace hamjet {

template <class Real>
FlowJet<Real> integrate_newmark(const FlowProblem<Real>& problem, const NewmarkSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<Real>& observer) {
  const Real half = Real(1) / 2;
  Splitting<Real> leapfrog{"Newmark", settings.step, {Real(1)}, {half, half}};
  if (!(settings.beta >= 0) || !(settings.beta <= 0.5)) {
    throw Error(ErrorKind::usage,
                fmt::format("Newmark: beta must be between 0 and 1/2, not {}", settings.beta));
  }
  if (settings.beta == 0) {
    return integrate_splitting(problem, std::move(leapfrog), statistics, observer);
  }
  validate(problem);
  statistics = {};
  validate_splitting(*problem.system, settings.step, leapfrog.method);
  if (problem.duration == 0) return starting_jet(problem);
  const long steps = equal_step_count(problem.duration, settings.step, leapfrog.method);
  const Real h = problem.duration / Real(steps);
  NewmarkForce<Real> force(problem, Real(Real(settings.beta) * h * h), statistics);
  return SplittingIntegration<Real, NewmarkForce<Real>>(problem, std::move(leapfrog), force, steps,
                                                        statistics, observer)
      .run();
}

template FlowJet<InstantiatedReal> integrate_newmark(const FlowProblem<InstantiatedReal>&,
                                                     const NewmarkSettings&, IntegrationStatistics&,
                                                     const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
