#pragma once

#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The task of an integrator, in the numbers of a run. The problem must outlive it.
template <class Real>
FlowProblem<Real> flow_problem(const ComputedProblem& problem, double duration);

/// Integrates with the method that the settings name. Throws as that method does; Error(usage) for
/// CVODE with Extended; Error(numerical) if the steps are beyond the method's limit of stability on
/// a linear system. `records_step_error` asks for the largest local error estimate even if this
/// takes extra work (fixed steps of Gauss, CVODE).
template <class Real>
FlowJet<Real> integrate(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer,
                        bool records_step_error = false);

/// The symmetry that the run of an integrator leaves out of its integration and puts back: none in
/// arcs, and none for methods that do not commute with it.
FlowSymmetry left_out(const Scene& scene, const ComputedProblem& problem,
                      const IntegratorSettings& settings);

/// Integrates in arcs if the method can be split; otherwise as integrate. See integrate_in_arcs.
template <class Real>
FlowJet<Real> integrate_split(const FlowProblem<Real>& flow, const IntegratorSettings& settings,
                              const ArcSettings& arcs, IntegrationStatistics& statistics,
                              ArcStatistics& arc_statistics, const StepObserver<Real>& observer,
                              const ArcProgress& progress, bool records_step_error);

/// For a run that has left out the shift in time: RunResult::time_shift_difference of its jet.
/// Empty if the lines cannot be integrated.
template <class Real>
std::vector<double> time_shift_difference(const FlowProblem<Real>& flow, const FlowJet<Real>& jet,
                                          const RunResult& run);

/// Estimates the error of an integration's jet; a failure of the independent runs is recorded. They
/// may take four times as many steps as the integration, or as many as ErrorEstimateSettings
/// allows. `progress` is called after their steps with the fraction that is done.
template <class Real>
JetErrorEstimate estimate_jet_error(const Scene& scene, const FlowProblem<Real>& flow,
                                    const FlowJet<Real>& jet,
                                    const IntegrationStatistics& statistics,
                                    const std::function<void(double)>& progress);

/// Integrates by Gauss with the same bits as integrate, and adds the jets at the scene's
/// `jet_times`, with error estimates if the scene has that check on; if the estimates fail, they
/// are left out. Throws as integrate_gauss.
template <class Real>
FlowJet<Real> integrate_with_times(const Scene& scene, const ComputedProblem& problem,
                                   const FlowProblem<Real>& flow, RunResult& run,
                                   const StepObserver<Real>& observer, bool records_step_error,
                                   const std::function<void(double)>& progress);

/// If the tolerance of a Gauss method has met rounding, of which only one draw is known, and the
/// estimate exceeds the promised error, raises IntegrationStatistics::rounding_by_degree to a
/// sample (sample_rounding), because a verdict must not depend on a single draw. Only then is this
/// work worth its time, which counts as time of the estimate. If a moved start cannot be
/// integrated, the single draw is kept. Precondition: the run has its jet and its error estimate.
/// `progress` may throw to stop.
template <class Real>
void sample_rounding_in_doubt(const Scene& scene, const FlowProblem<Real>& flow,
                              const FlowJet<Real>& jet, RunResult& run,
                              const std::function<void(double)>& progress);

/// The state of the whole model, from the state of the computed components; the others are zero.
std::vector<double> full_state(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                               std::size_t dimension);

/// The memory, in bytes, that a run with jets at several times may use for jets at its steps;
/// between the jets that are kept, steps are repeated.
inline constexpr double most_trajectory_bytes = 256e6;

/// Bytes of the series of one integration; a series has `coefficients` numbers of `real_bytes`
/// each.
double integration_memory(const IntegratorSettings& settings, const DynamicalSystem& system,
                          double coefficients, double real_bytes);

}  // namespace hamjet
