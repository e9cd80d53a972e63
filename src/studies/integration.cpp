#include "integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>

#include "../integrators/momentum_unit.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/newmark.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "hamjet/studies/arcs.hpp"
#include "stability_limit.hpp"
#include "stopwatch.hpp"

namespace hamjet {
namespace {

/// Lanes of the pack that holds this many stages.
int lanes_for(int stages) {
  int lanes = 1;
  while (lanes < stages) lanes *= 2;
  return lanes;
}

}  // namespace

template <class Real>
FlowProblem<Real> flow_problem(const ComputedProblem& problem, double duration) {
  FlowProblem<Real> flow{&problem.system, problem.space, problem.variables, {}, Real(duration)};
  for (const double x : problem.nominal) flow.initial_state.emplace_back(x);
  return flow;
}

namespace {

template <class Real>
FlowJet<Real> integrate_unchecked(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer, bool records_step_error) {
  switch (settings.method) {
    case IntegrationMethod::gauss: {
      auto gauss = std::get<GaussSettings>(splittable_method(settings));
      gauss.estimates_step_error = records_step_error;
      return integrate_gauss<Real>(flow, gauss, statistics, observer);
    }
    case IntegrationMethod::stormer:
      return integrate_stormer<Real>(flow, {*settings.step_canonical}, statistics, observer);
    case IntegrationMethod::velocity_verlet:
      if (settings.order == 2) {
        return integrate_velocity_verlet<Real>(flow, {*settings.step_canonical}, statistics,
                                               observer);
      }
      return integrate_symmetric_composition<Real>(flow, {settings.order, *settings.step_canonical},
                                                   statistics, observer);
    case IntegrationMethod::newmark:
      return integrate_newmark<Real>(flow, {settings.beta, *settings.step_canonical}, statistics,
                                     observer);
    case IntegrationMethod::fehlberg78:
      return integrate_fehlberg78<Real>(flow, {settings.step_canonical, settings.tolerance},
                                        statistics, observer);
    case IntegrationMethod::cvode_adams:
    case IntegrationMethod::cvode_bdf:
      break;
  }
  if constexpr (std::is_same_v<Real, double>) {
    CvodeSettings cvode;
    cvode.method =
        settings.method == IntegrationMethod::cvode_adams ? CvodeMethod::adams : CvodeMethod::bdf;
    cvode.tolerance = *settings.tolerance;
    cvode.records_step_error = records_step_error;
    return integrate_cvode(flow, cvode, statistics, observer);
  } else {
    throw Error(ErrorKind::usage, "CVODE computes in double precision only");
  }
}

/// Whether the method has fixed steps that can be too long for a linear system. Gauss methods are
/// stable for every step.
bool has_stability_limit(const IntegratorSettings& settings) {
  return settings.method != IntegrationMethod::gauss && settings.step_canonical.has_value();
}

/// The matrix of one step on a linear system.
Matrix<double> step_matrix(const DynamicalSystem& system, IntegratorSettings settings,
                           double step) {
  const std::size_t size = system.dimension();
  FlowProblem<double> problem{&system, SeriesSpace::create(size, 1), {}, {}, step};
  problem.variables.resize(size);
  std::iota(problem.variables.begin(), problem.variables.end(), std::size_t{0});
  problem.initial_state.assign(size, 0);
  settings.step_canonical = std::abs(step);
  IntegrationStatistics statistics;
  const auto jet = integrate_unchecked<double>(problem, settings, statistics, {}, false);
  return linear_part(std::span<const Series<double>>(jet));
}

void require_stable_steps(const DynamicalSystem& system, const IntegratorSettings& settings,
                          double duration) {
  const double count = std::ceil(std::abs(duration) / *settings.step_canonical * (1 - 1e-12));
  if (!(count >= 1)) return;
  const std::string method(method_names()[static_cast<std::size_t>(settings.method)]);
  require_stable_steps(
      system, {method, [&](double step) { return step_matrix(system, settings, step); },
               duration / count, duration, settings.method != IntegrationMethod::fehlberg78});
}

}  // namespace

template <class Real>
FlowJet<Real> integrate(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer,
                        bool records_step_error) {
  if (has_stability_limit(settings) && flow.system->vector_field.is_linear_system()) {
    require_stable_steps(*flow.system, settings, static_cast<double>(flow.duration));
  }
  return integrate_unchecked<Real>(flow, settings, statistics, observer, records_step_error);
}

template <class Real>
FlowJet<Real> integrate_split(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                              const ArcSettings& arcs, IntegrationStatistics& statistics,
                              ArcStatistics& arc_statistics, const StepObserver<Real>& observer,
                              const ArcProgress& progress, bool records_step_error) {
  if (has_stability_limit(settings) && flow.system->vector_field.is_linear_system()) {
    require_stable_steps(*flow.system, settings, static_cast<double>(flow.duration));
  }
  SplittableMethod method = splittable_method(settings);
  if (auto* gauss = std::get_if<GaussSettings>(&method)) {
    gauss->estimates_step_error = records_step_error;
  }
  return integrate_in_arcs<Real>(flow, method, arcs, statistics, arc_statistics, observer,
                                 progress);
}

template <class Real>
JetErrorEstimate estimate_jet_error(const Scene& scene, const FlowProblem<Real>& flow,
                                    const FlowJet<Real>& jet,
                                    const IntegrationStatistics& statistics,
                                    const std::function<void(double)>& progress) {
  JetErrorEstimate result;
  const Stopwatch stopwatch(result.seconds);
  ErrorEstimateSettings estimate;
  estimate.most_steps = std::max(estimate.most_steps, 4 * statistics.steps);
  estimate.momentum_exponent =
      natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal);
  estimate.progress = progress;
  try {
    result.by_degree = estimate_error<Real>(flow, jet, estimate);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    result.failure = error.what();
  }
  return result;
}

double integration_memory(const IntegratorSettings& settings, const DynamicalSystem& system,
                          double coefficients, double real_bytes) {
  const OperationList& list = system.evaluated_list();
  const double values = static_cast<double>(list.operations().size()) + 2;
  if (settings.method == IntegrationMethod::gauss) {
    return values * lanes_for(settings.stages) * real_bytes * coefficients;
  }
  // The states that odeint's 13 stages, or CVODE's Nordsieck array, hold, and one lane of series.
  return (values + 20 * static_cast<double>(system.dimension())) * real_bytes * coefficients;
}

template FlowProblem<double> flow_problem(const ComputedProblem&, double);
template FlowProblem<Extended> flow_problem(const ComputedProblem&, double);
template FlowJet<double> integrate(const FlowProblem<double>&, const IntegratorSettings&,
                                   IntegrationStatistics&, const StepObserver<double>&, bool);
template FlowJet<Extended> integrate(const FlowProblem<Extended>&, const IntegratorSettings&,
                                     IntegrationStatistics&, const StepObserver<Extended>&, bool);
template JetErrorEstimate estimate_jet_error(const Scene&, const FlowProblem<double>&,
                                             const FlowJet<double>&, const IntegrationStatistics&,
                                             const std::function<void(double)>&);
template JetErrorEstimate estimate_jet_error(const Scene&, const FlowProblem<Extended>&,
                                             const FlowJet<Extended>&, const IntegrationStatistics&,
                                             const std::function<void(double)>&);
template FlowJet<double> integrate_split(const FlowProblem<double>&, const IntegratorSettings&,
                                         const ArcSettings&, IntegrationStatistics&, ArcStatistics&,
                                         const StepObserver<double>&, const ArcProgress&, bool);
template FlowJet<Extended> integrate_split(const FlowProblem<Extended>&, const IntegratorSettings&,
                                           const ArcSettings&, IntegrationStatistics&,
                                           ArcStatistics&, const StepObserver<Extended>&,
                                           const ArcProgress&, bool);

}  // namespace hamjet
