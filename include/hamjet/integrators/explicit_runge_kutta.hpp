#pragma once

#include <optional>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// How an explicit Runge-Kutta method integrates; exactly one of both members is given.
struct ExplicitRungeKuttaSettings {
  /// For fixed steps: the duration is divided into equal steps not longer than this.
  std::optional<double> step = {};
  /// For controlled steps: absolute and relative tolerance, see integrate_fehlberg78.
  std::optional<double> tolerance = {};
};

/// Integrates the flow's jet with Boost.odeint's Runge-Kutta-Fehlberg 7(8): 13 evaluations on
/// series a step, of which the result of order 8 is carried on and the one of order 7 estimates its
/// error. The method is not symplectic: the exactness residual of its jet follows the tolerance.
///
/// With a tolerance, a step h is accepted if every coefficient c of every component satisfies
///
///   |error estimate of c| <= tolerance (1 + |c| + |h c'|) .
///
/// All degrees determine the step. The tolerance is absolute for coefficients below 1 and relative
/// above, in the system's own units. Coefficients of degree 2 and more start from zero, where a
/// relative tolerance alone would stop the integration, and soon grow large, where the relative
/// part takes over. An absolute error e of a coefficient of degree d moves the mapped point by e
/// times the d-th power of the deviation, so that in units in which deviations are below 1 the
/// absolute part never weakens the accuracy of the map. Coefficients that are exactly zero do not
/// hinder the control.
///
/// The pair sees no error at all where the derivative depends on time alone, or on a variable that
/// is linear in time: both results are the same there, a known weakness of Fehlberg's formula
/// (Hairer, Norsett and Wanner, Solving ODEs I, II.5).
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. In
/// `statistics`, rejected steps are steps that were repeated with a smaller size.
///
/// Throws Error(usage) for settings out of range (a tolerance below the rounding of Real included),
/// Error(too_large) for more than 1e8 steps, Error(numerical), naming the time, if the vector field
/// is not finite, if the step size underflows, or if the nominal's energy shows that the
/// integration stepped over a singularity. This is a change of the energy by more than 1 % + 1e3
/// tolerance (at most 10 %; 1 % with fixed steps) of the energy itself or of a hundredth of the
/// terms that cancel in it.
///
/// Source: Fehlberg, NASA TR R-287 (1968); Boost.odeint, runge_kutta_fehlberg78.
template <class Real>
FlowJet<Real> integrate_fehlberg78(const FlowProblem<Real>& problem,
                                   const ExplicitRungeKuttaSettings& settings,
                                   IntegrationStatistics& statistics,
                                   const StepObserver<Real>& observer = {});

}  // namespace hamjet
