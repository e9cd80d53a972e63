#include "integration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "../algebra/raise_to.hpp"
#include "../integrators/gauss/gauss_tolerance.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../integrators/symmetry/symmetry_reduction.hpp"
#include "arcs.hpp"
#include "checks/error_promise.hpp"
#include "checks/negligible_degrees.hpp"
#include "checks/smooth_forces.hpp"
#include "descriptions/method_description.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "stability/stability_limit.hpp"
#include "stopwatch.hpp"

namespace hamjet {
template <class Real>
FlowProblem<Real> flow_problem(const ComputedProblem& problem, double duration) {
  FlowProblem<Real> flow{problem.system,     problem.space, problem.variables, {},
                         problem.start_time, Real(duration)};
  for (const double x : problem.nominal) flow.initial_state.emplace_back(x);
  flow.symmetry = problem.symmetry;
  return flow;
}

namespace {

template <class Real>
FlowJet<Real> integrate_unchecked(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer, bool records_step_error) {
  const MethodDescription& method = description_of(settings.method);
  MethodIntegration::Function<Real> integrate = nullptr;
  if constexpr (std::is_same_v<Real, double>) {
    integrate = method.integrate.in_double;
  } else {
    integrate = method.integrate.in_extended;
  }
  if (integrate == nullptr) {
    throw Error(ErrorKind::usage,
                fmt::format("{} computes in double precision only",
                            method.library.empty() ? method.name : method.library));
  }
  return integrate(flow, settings, statistics, observer, records_step_error);
}

/// Whether the method has fixed steps that can be too long for a linear system.
bool has_stability_limit(const IntegratorSettings& settings) {
  return !description_of(settings.method).is_stable_for_every_step &&
         settings.step_canonical.has_value();
}

/// Whether the steps of a method are all the same linear map, whose limit is that of one step.
bool has_constant_coefficients(const DynamicalSystem& system) {
  return system.vector_field.is_linear_system() && system.is_autonomous();
}

/// The matrix of one step on a linear system.
Matrix<double> step_matrix(const SharedSystem& system, IntegratorSettings settings,
                           const ClockTime& start_time, double step) {
  const std::size_t size = system->dimension();
  FlowProblem<double> problem{system, SeriesSpace::create(size, 1), {}, {}, start_time, step};
  problem.variables.resize(size);
  std::iota(problem.variables.begin(), problem.variables.end(), std::size_t{0});
  problem.initial_state.assign(size, 0);
  settings.step_canonical = std::abs(step);
  IntegrationStatistics statistics;
  const auto jet = integrate_unchecked<double>(problem, settings, statistics, {}, false);
  return linear_part(jet);
}

void require_stable_steps(const SharedSystem& system, const IntegratorSettings& settings,
                          const ClockTime& start_time, double duration) {
  const double count = std::ceil(std::abs(duration) / *settings.step_canonical * (1 - 1e-12));
  if (!(count >= 1)) return;
  const MethodDescription& method = description_of(settings.method);
  const auto matrix = [&](double step) { return step_matrix(system, settings, start_time, step); };
  require_stable_steps(*system, {std::string(method.name), matrix, duration / count, duration,
                                 method.preserves_a_two_form});
}

ErrorEstimateSettings estimate_settings(const Scene& scene,
                                        const std::function<void(double)>& progress) {
  ErrorEstimateSettings settings;
  settings.momentum_exponent =
      natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal);
  settings.progress = progress;
  settings.has_smooth_forces = has_smooth_forces(scene.system);
  return settings;
}

}  // namespace

template <class Real>
FlowJet<Real> integrate(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer,
                        bool records_step_error) {
  if (has_stability_limit(settings) && has_constant_coefficients(*flow.system)) {
    require_stable_steps(flow.system, settings, flow.start_time,
                         static_cast<double>(flow.duration));
  }
  return integrate_unchecked<Real>(flow, settings, statistics, observer, records_step_error);
}

template <class Real>
FlowJet<Real> integrate_split(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                              const ArcSettings& arcs, IntegrationStatistics& statistics,
                              ArcStatistics& arc_statistics, const StepObserver<Real>& observer,
                              const ArcProgress& progress, bool records_step_error) {
  if (has_stability_limit(settings) && has_constant_coefficients(*flow.system)) {
    require_stable_steps(flow.system, settings, flow.start_time,
                         static_cast<double>(flow.duration));
  }
  SplittableMethod method = splittable_method(settings);
  if (auto* gauss = std::get_if<GaussSettings>(&method)) {
    gauss->estimates_step_error = records_step_error;
  }
  return integrate_in_arcs<Real>(flow, method, arcs, statistics, arc_statistics, observer,
                                 progress);
}

FlowSymmetry left_out(const Scene& scene, const ComputedProblem& problem,
                      const IntegratorSettings& settings) {
  const bool is_whole = scene.arcs == std::optional<std::size_t>(1);
  if (!is_whole || !description_of(settings.method).splittable(settings)) return FlowSymmetry::none;
  const auto reduction =
      SymmetryReduction<double>::of(flow_problem<double>(problem, scene.duration));
  return reduction ? reduction->left_out() : FlowSymmetry::none;
}

template <class Real>
JetErrorEstimate estimate_jet_error(const Scene& scene, const FlowProblem<Real>& flow,
                                    const FlowJet<Real>& jet,
                                    const IntegrationStatistics& statistics,
                                    const std::function<void(double)>& progress) {
  JetErrorEstimate result;
  const Stopwatch stopwatch(result.seconds);
  ErrorEstimateSettings estimate = estimate_settings(scene, progress);
  estimate.most_steps = std::max(estimate.most_steps, 4 * statistics.steps);
  const std::vector<double> shares =
      shares_of_linear<Real>(scene, flow, jet, estimate.momentum_exponent);
  try {
    using Lines = std::vector<JetAlongLine<Real>>;
    const auto* known = std::get_if<Lines>(&statistics.finer_lines);
    // The steps of these are chosen by the nominal, which shows little of what air and light, much
    // weaker than the field, do to deviations.
    const auto& earth = scene.system.earth;
    if (earth && (earth->atmosphere || earth->radiation)) known = nullptr;
    const Lines lines = known != nullptr ? *known : Lines{};
    // Steps that a looser tolerance chose leave more than long lines do at the seams.
    constexpr double coarse_tolerance = 1e-18;
    const bool is_coarse = statistics.step_tolerance.value_or(0) >= coarse_tolerance;
    estimate.has_smooth_forces = estimate.has_smooth_forces || is_coarse;
    try {
      result.by_degree = estimate_error<Real>(flow, jet, estimate, lines);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::too_large || estimate.has_smooth_forces) throw;
      estimate.has_smooth_forces = true;
      result.by_degree = estimate_error<Real>(flow, jet, estimate, lines);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    result.failure = error.what();
  }
  const int last = last_degree(shares);
  if (!result.by_degree && last < flow.space->order()) {
    // No steps resolve coefficients that are rounding; the degrees below them have an estimate. All
    // of what is above may be wrong.
    try {
      const FlowProblem<Real> lower = of_lower_order(flow, last);
      result.by_degree = estimate_error<Real>(lower, of_lower_order(jet, lower.space), estimate);
      result.by_degree->resize(shares.size(), 1);
      result.failure.clear();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    }
  }
  if (result.by_degree) tell_beside_linear(*result.by_degree, shares);
  return result;
}

template <class Real>
FlowJet<Real> integrate_with_times(const Scene& scene, const ComputedProblem& problem,
                                   const FlowProblem<Real>& flow, RunResult& run,
                                   const StepObserver<Real>& observer, bool records_step_error,
                                   const std::function<void(double)>& progress) {
  auto gauss = std::get<GaussSettings>(splittable_method(run.settings));
  gauss.estimates_step_error = records_step_error;
  const JetTrajectory<Real> trajectory(flow, gauss, most_trajectory_bytes, observer);
  run.statistics = trajectory.statistics();
  std::vector<Real> times;
  std::vector<FlowJet<Real>> jets;
  for (const double time : scene.jet_times) {
    times.emplace_back(time);
    jets.push_back(trajectory.at(times.back()));
    run.jets.push_back({time, convert_map<Extended>(jets.back()), {}, {}});
    run.jets.back().nominal = full_state(run.jets.back().jet, problem, scene.nominal.size());
  }
  if (!scene.checks[SelfCheckName::error_estimate].is_on) return trajectory.final_jet();
  ErrorEstimateSettings settings = estimate_settings(scene, progress);
  settings.most_steps = std::max(settings.most_steps, 4 * run.statistics.steps);
  try {
    const auto estimates = estimate_errors<Real>(flow, times, jets, settings);
    for (std::size_t i = 0; i < jets.size(); ++i) run.jets[i].error_estimate = estimates[i];
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
  }
  return trajectory.final_jet();
}

template <class Real>
void sample_rounding_in_doubt(const Scene& scene, const FlowProblem<Real>& flow,
                              const FlowJet<Real>& jet, RunResult& run,
                              const std::function<void(double)>& progress) {
  std::vector<double>& rounding = run.statistics.rounding_by_degree;
  const std::optional<double>& step_tolerance = run.statistics.step_tolerance;
  if (rounding.empty() || !step_tolerance || !exceeds_promise(scene, run)) return;
  const Stopwatch stopwatch(run.error_estimate.seconds);
  const SplittableMethod method = splittable_method(run.settings);
  const auto along_line = [&](const FlowProblem<Real>& line) {
    IntegrationStatistics statistics;
    return integrate_with_step_tolerance<Real>(line, std::get<GaussSettings>(method),
                                               *step_tolerance, statistics);
  };
  try {
    const std::vector<double> sampled =
        sample_rounding<Real>(flow, jet, along_line, estimate_settings(scene, progress));
    for (std::size_t d = 0; d < rounding.size(); ++d) raise_to(rounding[d], sampled[d]);
  } catch (const Error& error) {
    // The jet itself is complete; it is judged by the single draw that is known.
    if (error.kind() != ErrorKind::numerical) throw;
  }
}

std::vector<double> full_state(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                               std::size_t dimension) {
  std::vector<double> state(dimension, 0);
  for (std::size_t i = 0; i < jet.size(); ++i) {
    state[problem.components[i]] = static_cast<double>(jet[i][0]);
  }
  return state;
}

double integration_memory(const IntegratorSettings& settings, const DynamicalSystem& system,
                          double coefficients, double real_bytes) {
  const OperationList& list = system.evaluated_list();
  const double values = static_cast<double>(list.operations().size()) + 2;
  return description_of(settings.method)
             .numbers_held(settings, values, static_cast<double>(system.dimension())) *
         real_bytes * coefficients;
}

template FlowProblem<double> flow_problem(const ComputedProblem&, double);
template FlowProblem<Extended> flow_problem(const ComputedProblem&, double);
template FlowJet<double> integrate(const FlowProblem<double>&, const IntegratorSettings&,
                                   IntegrationStatistics&, const StepObserver<double>&, bool);
template FlowJet<Extended> integrate(const FlowProblem<Extended>&, const IntegratorSettings&,
                                     IntegrationStatistics&, const StepObserver<Extended>&, bool);
template FlowJet<double> integrate_with_times(const Scene&, const ComputedProblem&,
                                              const FlowProblem<double>&, RunResult&,
                                              const StepObserver<double>&, bool,
                                              const std::function<void(double)>&);
template FlowJet<Extended> integrate_with_times(const Scene&, const ComputedProblem&,
                                                const FlowProblem<Extended>&, RunResult&,
                                                const StepObserver<Extended>&, bool,
                                                const std::function<void(double)>&);
template void sample_rounding_in_doubt(const Scene&, const FlowProblem<double>&,
                                       const FlowJet<double>&, RunResult&,
                                       const std::function<void(double)>&);
template void sample_rounding_in_doubt(const Scene&, const FlowProblem<Extended>&,
                                       const FlowJet<Extended>&, RunResult&,
                                       const std::function<void(double)>&);
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
