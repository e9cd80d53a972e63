#pragma once

#include <optional>
#include <vector>

#include "../directional_flow.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The local tolerance of an adaptive Gauss integration.
template <class Real>
struct StepTolerance {
  double tolerance = 0;  ///< for GaussStepControl
  /// By degree, the relative error that shorter steps do not take away, for it is rounding; empty
  /// where every degree meets the tolerance asked for.
  std::vector<double> rounding_by_degree;
  /// By degree, the relative error of the last trial if none met the tolerance; empty otherwise.
  std::vector<double> unmet_by_degree;
  /// The lines of the last trial's finer steps; empty where nothing was tried.
  std::vector<JetAlongLine<Real>> finer_lines;
  /// These lines with the steps of `tolerance`; empty where the last trial had another.
  std::vector<FlowJet<Real>> lines;
};

/// A jet that was integrated with the tolerance asked for, before it is known whether that
/// suffices.
template <class Real>
struct FirstTrial {
  const FlowJet<Real>& jet;
  const IntegrationStatistics& statistics;
};

/// Whether a tolerance has to be chosen: see choose_step_tolerance.
template <class Real>
bool needs_choice(const FlowProblem<Real>& problem, const GaussSettings& settings);

/// The largest local tolerance, at most that of the settings, with which the error of every degree
/// of the jet stays below
///
///   3 tolerance max(1, periods) ,
///
/// periods being those of the linearised motion (IntegrationStatistics::periods). Steps that suit
/// the nominal need not suit the coefficients: those of degree d are larger at a perigee than at
/// the end of the arc by the d-th power of the ratio of the time scales there, and their errors
/// with them.
///
/// The flow is integrated along two lines (DirectionalFlow) with the settings' steps and with finer
/// ones of another order; their difference is the error of each degree, which falls with the local
/// tolerance until it meets rounding, which is what a tolerance at least ten times smaller does not
/// halve, twice in a row. Source of the order: Hairer, Lubich and Wanner, Geometric Numerical
/// Integration, section II.1; of the restriction to lines, see DirectionalFlow.
///
/// Settings of fixed steps, and jets of order 0 in a field without short waves, need none: the
/// settings' tolerance is returned, or 0. Throws what integrate_gauss throws.
///
/// A jet that was integrated with the settings' own tolerance may be given as the first trial.
/// The two integrations of a trial are done on up to `threads` threads, with the same result on any
/// number.
template <class Real>
StepTolerance<Real> choose_step_tolerance(const FlowProblem<Real>& problem,
                                          const GaussSettings& settings, std::size_t threads = 1,
                                          const FirstTrial<Real>* first = nullptr);

/// choose_step_tolerance where the first trial, the jet's own lines and the finer ones, of so many
/// periods, are there already; none if it does not meet the tolerance asked for.
template <class Real>
std::optional<StepTolerance<Real>> accept_first_trial(const GaussSettings& settings,
                                                      const DirectionalFlow<Real>& flow,
                                                      std::vector<FlowJet<Real>> lines,
                                                      std::vector<FlowJet<Real>> finer_lines,
                                                      double periods);

/// Adds what the choice has found to the statistics of the integration that it was made for.
template <class Real>
void record_choice(StepTolerance<Real> choice, IntegrationStatistics& statistics);

/// Integrates with the steps of a local tolerance that was chosen before
/// (IntegrationStatistics::step_tolerance), without another choice.
template <class Real>
FlowJet<Real> integrate_with_step_tolerance(const FlowProblem<Real>& problem,
                                            GaussSettings settings, double step_tolerance);

/// Settings for an integration that shares neither order nor steps with one of the given settings,
/// with a local error a thousand times smaller.
template <class Real>
GaussSettings finer_gauss(const GaussSettings& settings, double tolerance);

}  // namespace hamjet
