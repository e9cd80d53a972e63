#pragma once

#include <optional>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Seconds spent in the parts of a Gauss integration, for benchmarks.
struct GaussProfile {
  double nominal = 0;        ///< Newton's iteration on plain numbers and the step size control
  double factorisation = 0;  ///< factorisation of the stage system, once per step
  double series = 0;         ///< products of series: the remainders
  double linear_solves = 0;  ///< the stage slices from the remainders
  double update = 0;         ///< linear parts of the intermediates and the new state
};

/// Settings of a Gauss collocation method.
struct GaussSettings {
  int stages = 8;  ///< 1 (the implicit midpoint rule) to 16; the order is 2 stages
  /// For fixed steps: the duration is divided into equal steps not longer than this.
  std::optional<double> step;
  /// For adaptive steps: the allowed relative error of every degree of the jet, per period of the
  /// motion.
  std::optional<double> tolerance;
  bool compensated_summation =
      true;  ///< compensated summation of the steps; without it round-off grows faster
  /// Whether to estimate the error of fixed steps too, which takes some hundred operations per step
  /// on plain numbers. Adaptive steps are always estimated.
  bool estimates_step_error = false;
  /// Whether each adaptive step is judged by every degree of its own series, instead of by a local
  /// tolerance that is chosen beforehand along two lines. A step is repeated with all its series if
  /// its estimate exceeds the tolerance a thousand times. This is cheap with few variables, and
  /// meant for tolerances far below the accuracy that is needed.
  bool controls_all_degrees = false;
  GaussProfile* profile =
      nullptr;  ///< receives the profile, if given; costs a few readings of the clock per step
};

/// Integrates the flow's jet with a Gauss collocation method, applied exactly to series. The result
/// is the jet of the numerical map. This map is symplectic, so that its generating functions exist
/// to round-off for any step (but exactness is not accuracy).
///
/// A step solves degree 0 by fixed-point iteration, or by Newton's method where fixed-point
/// iteration does not contract. Then it solves each degree by one evaluation on series and one
/// linear solve (see SliceEvaluator, StageSystem, StageIteration). Step sizes depend on the nominal
/// alone and are constants with respect to the deviations, so that variable steps keep the map
/// symplectic. They are chosen such that
///
///   100 (defect / largest slope)^2 = local tolerance ,
///
/// where the defect is the distance, at the start of the step, between the slope and the
/// collocation polynomial that was fitted to the slopes inside the step. It is about the first
/// neglected Legendre mode, whose square has the order 2s of the method. The factor 100 is
/// empirical: with it the error of the coefficients of degree 0..4 of a nearly circular orbit,
/// relative to the largest of their degree, is near the local tolerance after a few revolutions
/// (that of the nominal is some 50 times smaller). Three further conditions limit the step. It must
/// be short enough for the linearised equations (h times their frequency), because a nominal at
/// rest, or one that does not move in the direction of the deviations, does not show these. It must
/// be short enough for modes that decay more slowly than those of a field of a single scale. And
/// the field's shortest wave (DynamicalSystem::waves_on_a_circle) must have two stages.
///
/// The local tolerance is the settings' tolerance or less. For jets of order 1 and more, it is
/// reduced until the error of every degree is below 3 tolerance max(1, periods), where the periods
/// are those of the linearised motion. The error is measured along two lines of deviations, on
/// which the flow costs little. If rounding alone exceeds this limit, steps are shortened only
/// until this is evident, and IntegrationStatistics::rounding_by_degree has the error that remains.
/// The update is summed with compensation, unless the settings say otherwise.
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
