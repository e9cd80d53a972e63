#pragma once

#include <optional>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Seconds spent in the parts of a Gauss integration, for benchmarks.
struct GaussProfile {
  double nominal = 0;        ///< Newton's iteration on plain numbers and the step size control
  double factorisation = 0;  ///< of the stage system, once a step
  double series = 0;         ///< products of series: the remainders
  double linear_solves = 0;  ///< the stage slices from the remainders
  double update = 0;         ///< linear parts of the intermediates and the new state
};

/// How a Gauss collocation method integrates.
struct GaussSettings {
  int stages = 8;              ///< 1 (the implicit midpoint rule) to 16; the order is 2 stages
  std::optional<double> step;  ///< fixed: the span is cut into equal steps not longer than this
  /// Adaptive: the relative error of every degree of the jet, for each period of the motion.
  std::optional<double> tolerance;
  bool compensated_summation = true;  ///< of the steps; without it round-off grows faster
  /// Also estimate the error of fixed steps (adaptive ones are always estimated), at some hundred
  /// operations a step on plain numbers.
  bool estimates_step_error = false;
  /// Each adaptive step is judged by every degree of its own series, in place of a local tolerance
  /// chosen beforehand along two lines. A step is repeated with all its series if its estimate
  /// exceeds the tolerance a thousand times. Cheap with few variables; meant for tolerances far
  /// below what is wanted.
  bool controls_all_degrees = false;
  GaussProfile* profile = nullptr;  ///< filled where given; costs a few clock readings a step
};

/// Integrates the flow's jet with a Gauss collocation method, exactly as the method acts on series:
/// the result is the jet of the numerical map, which is symplectic, so its generating functions
/// exist to round-off whatever the step (but exactness is not accuracy).
///
/// A step solves degree 0 by fixed-point iteration, or by Newton's method where that does not
/// contract, then each degree by one evaluation on series and one linear solve (see SliceEvaluator,
/// StageSystem, StageIteration). Step sizes depend on the nominal alone and are
/// constants with respect to the deviations, so variable steps keep the map symplectic. They are
/// chosen to make
///
///   100 (defect / largest slope)^2 = local tolerance ,
///
/// defect being the distance, at the start of the step, between the slope and the collocation
/// polynomial that was fitted to it inside: about the first neglected Legendre mode, whose square
/// has the order 2s of the method. The factor is empirical: the error of the coefficients of degree
/// 0..4 of a nearly circular orbit, relative to the largest of their degree, then comes out near
/// the local tolerance after a few revolutions (that of the nominal some 50 times below). A step is
/// also short enough for the linearised equations (h times their frequency), of which a nominal at
/// rest, or one that does not move where the deviations do, shows nothing; for modes that decay
/// more slowly than those of a field of one scale do; and for two stages on the field's shortest
/// wave (DynamicalSystem::waves_on_a_circle).
///
/// The local tolerance is the settings' tolerance or less: as much less as is found to keep the
/// error of every degree below 3 tolerance max(1, periods), periods being those of the linearised
/// motion, along two lines of deviations on which the flow costs little (GaussSettings::tolerance
/// is checked for jets of order 1 and more). Where rounding alone exceeds that, no shorter steps
/// are taken than show it, and IntegrationStatistics::rounding_by_degree says by how much. The
/// update is summed with compensation, unless the settings say not to.
///
/// Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, sections II.1 and VIII.6.
/// Throws Error(usage) for settings out of range, Error(numerical) if the stage equations have no
/// solution connected to the start of the step (with fixed steps), if the step size underflows, or
/// if a coefficient is not finite; the message names time and step.
template <class Real>
FlowJet<Real> integrate_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                              IntegrationStatistics& statistics,
                              const StepObserver<Real>& observer = {});

}  // namespace hamjet
