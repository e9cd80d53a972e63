#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Settings of Newmark's method; its gamma is 1/2.
struct NewmarkSettings {
  double beta = 0.25;  ///< 0 to 1/2; 0 is velocity Verlet, 1/4 the average acceleration method
  /// Longest step, in the system's unit of time, positive; the duration is divided into equal
  /// steps.
  double step = 0;
};

/// Integrates the flow's jet with Newmark's method, gamma = 1/2, with v = M^-1 p, a = M^-1 F(q):
///
///   q_(k+1) = q_k + h v_k + h^2 ((1/2 - beta) a_k + beta a_(k+1)),
///   v_(k+1) = v_k + (h/2) (a_k + a_(k+1)) .
///
/// The method has order 2, is symmetric, and implicit for beta > 0; it is applied exactly to
/// series. It needs a system with a second-order form q' = M^-1 p, p' = F(q)
/// (DynamicalSystem::second_order).
///
/// For beta > 0 the map is *not* symplectic in (q, M v), so that its generating functions do not
/// exist there: dp ^ dq^d is preserved, where q^d = q - beta h^2 a(q) and p = M v. In these
/// variables the method is leapfrog, and it is computed in this form:
///
///   q^d_(k+1) = q^d_k + h M^-1 p_(k+1/2),   p_(k+3/2) = p_(k+1/2) + h F(q_(k+1)) ,
///
/// where q_(k+1) - beta h^2 a(q_(k+1)) = q^d_(k+1) is solved at degree 0 by Newton's method to
/// round-off, then at each degree by one evaluation on series and one linear solve with a matrix
/// that is factored once a step.
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. The
/// update is summed with compensation.
///
/// Source: N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67; C. Kane, J. E. Marsden, M. Ortiz
/// and M. West, Int. J. Numer. Meth. Eng. 49 (2000) 1295 (the preserved two-form); Guibout and
/// Bloch, corrected. Throws Error(usage) for settings out of range and for a system without
/// second-order form, Error(too_large) for more than 1e8 steps, Error(numerical), naming time and
/// step, if the implicit equation has no solution connected to the start of the step, or if the
/// force or a coefficient is not finite.
template <class Real>
FlowJet<Real> integrate_newmark(const FlowProblem<Real>& problem, const NewmarkSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<Real>& observer = {});

}  // namespace hamjet
