#pragma once

#include <optional>
#include <vector>

#include "../directional_flow.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The local tolerance of an adaptive Gauss integration.
template <class Real>
struct StepTolerance {
  double tolerance = 0;  ///< the tolerance for GaussStepControl
  /// By degree, the relative error that shorter steps do not reduce because it is rounding; empty
  /// if every degree meets the requested tolerance.
  std::vector<double> rounding_by_degree;
  /// The relative error by degree of the last trial if no trial met the tolerance; otherwise empty.
  std::vector<double> unmet_by_degree;
  /// The lines of the last trial with finer steps; empty if nothing was tried.
  std::vector<JetAlongLine<Real>> finer_lines;
  /// The lines of the last trial with the steps of `tolerance`; empty if it had another tolerance.
  std::vector<FlowJet<Real>> lines;
};

/// A jet that was integrated with the requested tolerance before it is known whether this suffices.
template <class Real>
struct FirstTrial {
  const FlowJet<Real>& jet;
  const IntegrationStatistics& statistics;
};

/// Whether a tolerance has to be chosen: see choose_step_tolerance.
template <class Real>
bool needs_choice(const FlowProblem<Real>& problem, const GaussSettings& settings);

/// Finds the largest local tolerance, at most that of the settings, with which the error of every
/// degree of the jet stays below
///
///   3 tolerance max(1, periods) ,
///
/// where the periods are those of the linearised motion (IntegrationStatistics::periods). Steps
/// that suit the nominal need not suit the coefficients. Coefficients of degree d are larger at a
/// perigee than at the end of the arc, by the d-th power of the ratio of the time scales there, and
/// so are their errors.
///
/// The flow is integrated along two lines (DirectionalFlow) with the settings' steps and with finer
/// ones of another order. The difference is the error of each degree. It falls with the local
/// tolerance until it meets rounding; an error counts as rounding if, twice in a row, a tolerance
/// at least ten times smaller does not halve it. Source of the order: Hairer, Lubich and Wanner,
/// Geometric Numerical Integration, section II.1; of the restriction to lines, see DirectionalFlow.
///
/// Settings of fixed steps, and jets of order 0 in a field without short waves, need no choice: the
/// settings' tolerance, or 0, is returned. Throws what integrate_gauss throws.
///
/// A jet that was integrated with the settings' own tolerance may be given as the first trial. The
/// two integrations of a trial run on up to `threads` threads, with the same result for any number.
template <class Real>
StepTolerance<Real> choose_step_tolerance(const FlowProblem<Real>& problem,
                                          const GaussSettings& settings, std::size_t threads = 1,
                                          const FirstTrial<Real>* first = nullptr);

/// choose_step_tolerance if the first trial exists already: the jet's own lines, and the finer
/// lines with their number of periods. No value if the trial does not meet the requested tolerance.
template <class Real>
std::optional<StepTolerance<Real>> accept_first_trial(const GaussSettings& settings,
                                                      const DirectionalFlow<Real>& flow,
                                                      std::vector<FlowJet<Real>> lines,
                                                      std::vector<FlowJet<Real>> finer_lines,
                                                      double periods);

/// Adds the results of the choice to the statistics of the integration for which it was made.
template <class Real>
void record_choice(StepTolerance<Real> choice, IntegrationStatistics& statistics);

/// Integrates with the steps of a local tolerance that was chosen before
/// (IntegrationStatistics::step_tolerance), without a new choice. No symmetry is left out.
template <class Real>
FlowJet<Real> integrate_with_step_tolerance(const FlowProblem<Real>& problem,
                                            GaussSettings settings, double step_tolerance,
                                            IntegrationStatistics& statistics);

/// Settings for an integration that has another order and other steps than one with the given
/// settings, and a local error a thousand times smaller.
template <class Real>
GaussSettings finer_gauss(const GaussSettings& settings, double tolerance);

}  // namespace hamjet
