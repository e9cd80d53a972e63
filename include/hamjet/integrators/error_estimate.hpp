#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The factor of safety of estimate_error, by which an estimate is above the error that it sees.
inline constexpr double error_estimate_safety = 2;

/// How the error of a jet is estimated.
struct ErrorEstimateSettings {
  /// Tolerance of the independent runs, for every degree; by default four times the rounding of the
  /// numbers.
  std::optional<double> tolerance = {};
  /// Most steps of an independent run; more are refused with Error(too_large).
  long most_steps = 5000;
  /// Momenta are compared with positions, and directions drawn, in units of two to this power.
  int momentum_exponent = 0;
  /// Called after steps of the independent runs with the fraction that is done. May throw to stop.
  std::function<void(double)> progress = {};
};

/// Estimates the error of every degree of a delivered jet without a reference: entry d is about the
/// largest error of a coefficient of degree d, relative to the largest coefficient of that degree,
/// truncation and rounding together. How the jet was made does not matter.
///
/// Along eight directions, and again along two of them, the univariate series of the same flow are
/// integrated independently, side by side: Gauss with 16 and with 15 stages, whose steps are chosen
/// for all degrees. The jet's degree-d part at a direction, less the degree-d coefficient of that
/// run, is the sum of the errors of all monomials of the degree with weights of order 1. The
/// estimate is the root mean square of these differences over a run's directions, relative to the
/// smaller of the jet's largest coefficient and that mean of the run, times error_estimate_safety,
/// the larger of both runs, and never below the rounding of Real.
///
/// Where `known` has independent jets of this flow along lines, by other stages and finer steps
/// than the delivered jet's (IntegrationStatistics::finer_lines), they take the place of the second
/// run, with differences relative to the jet along the line; and the second run is made all the
/// same if they show ten times the error of the first at some degree, or if a degree of the jet is
/// thirty times larger or smaller along one of them than its largest coefficients.
///
/// Directions are drawn from a generator of constant seed, entries of random sign between
/// sqrt(1/2) and sqrt(2) in magnitude so that no monomial is lost; of sixteen the eight are taken
/// at which the degrees of the jet are nearest in size to their largest coefficients, so that large
/// monomials do not cancel.
///
/// How far it can be below the error: a direction sees less than a tenth of an error by chance
/// alone. Where rounding dominates, the run's own error is a sample of the same distribution as the
/// jet's; for normal ones P(|e| > x |e - e'|) is about 0.32 / x. Where truncation dominates, the
/// error of degree d is about (g.x)^d, g being what a step resolves worst, over few steps: on 530
/// ellipses of orders 5 to 8 over parts of a revolution the error was up to 290 times what the best
/// two of sixteen directions show; it is at most 3 times the mean over eight, and that at most 60
/// times the error (99 % within 27), where the largest of the two was up to 130 times (49). The
/// tests measure this over hundreds of random scenes.
///
/// Returns zeros for a duration of zero, where the jet is exact. Throws Error(usage) if the jet
/// or a known line does not fit the problem, Error(numerical) if the independent run fails,
/// Error(too_large) if it would take too many steps.
template <class Real>
std::vector<double> estimate_error(const FlowProblem<Real>& problem, const FlowJet<Real>& jet,
                                   const ErrorEstimateSettings& settings = {},
                                   const std::vector<JetAlongLine<Real>>& known = {});

/// estimate_error for jets of one flow at several times, by degree for each, from two runs in all:
/// those along the directions, which are drawn for the last of the jets, have their series at every
/// time (JetTrajectory). Times are between 0, which is none of them, and the problem's
/// duration. Relative to the largest coefficient of the degree at the time: near the start the high
/// degrees vanish. Throws as estimate_error and JetTrajectory::at, and Error(usage) if times and
/// jets are not of one number.
template <class Real>
std::vector<std::vector<double>> estimate_errors(const FlowProblem<Real>& problem,
                                                 const std::vector<Real>& times,
                                                 const std::vector<FlowJet<Real>>& jets,
                                                 const ErrorEstimateSettings& settings = {});

/// By degree, what estimate_error makes of rounding alone: the delivered jet's own integration,
/// `integrate`, along those eight directions, from four starts each whose coefficients are moved by
/// up to half a unit in the last place of the largest position, or momentum, of their degree; the
/// largest of the four root mean squares of the differences from the start that is not moved, in
/// the scale of the estimate but without its factor of safety. A moved start has all later
/// roundings drawn anew, so that each is a draw of what the estimate sees of rounding; truncation
/// is the same in all. Throws as estimate_error does, and what `integrate` throws.
template <class Real>
std::vector<double> sample_rounding(
    const FlowProblem<Real>& problem, const FlowJet<Real>& jet,
    const std::function<FlowJet<Real>(const FlowProblem<Real>&)>& integrate,
    const ErrorEstimateSettings& settings = {});

}  // namespace hamjet
