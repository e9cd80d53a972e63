#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

// Explicit symplectic methods for a system with a second-order form q' = M^-1 p, p' = F(q)
// (DynamicalSystem::second_order). Each is exactly the method acting on series: the result is the
// jet of the numerical map, which is symplectic, so its generating functions exist to round-off
// whatever the step (but exactness is not accuracy).

/// How Störmer's rule integrates.
struct StormerSettings {
  /// Longest step, in the system's unit of time, positive; the span is cut into equal steps.
  double step = 0;
};

/// How velocity Verlet integrates.
struct VelocityVerletSettings {
  /// Longest step, in the system's unit of time, positive; the span is cut into equal steps.
  double step = 0;
};

/// Integrates the flow's jet with Störmer's rule as the paper writes it in Hamiltonian form, with
/// p_k read at t_k:
///
///   p_(k+1) = p_k + h F(q_k),   q_(k+1) = q_k + h M^-1 p_(k+1) .
///
/// That is the symplectic Euler method: order 1, not symmetric, so that a run forwards and one
/// backwards differ. It takes one evaluation on series a step.
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. The
/// update is summed with compensation. A nominal that steps over a collision is not noticed.
///
/// Source: Guibout and Bloch, eq. `stormer_h1`, corrected; Hairer, Lubich and Wanner, Geometric
/// Numerical Integration, section I.1.2. Throws Error(usage) for a step that is not positive and
/// for a system without second-order form, Error(too_large) for more than 1e8 steps,
/// Error(numerical), naming time and step, if the force or a coefficient is not finite.
template <class Real>
FlowJet<Real> integrate_stormer(const FlowProblem<Real>& problem, const StormerSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<Real>& observer = {});

/// Integrates the flow's jet with velocity Verlet, with a = M^-1 F(q):
///
///   q_(k+1) = q_k + h M^-1 p_k + (h^2/2) a_k,   p_(k+1) = p_k + (h/2) (F(q_k) + F(q_(k+1))) .
///
/// It has order 2, is symmetric and takes one evaluation on series a step, and one at the start:
/// the force at the end of a step is that at the start of the next. Limits, errors and summation
/// are those of integrate_stormer.
///
/// Source: Guibout and Bloch, eq. `legendre_vv`, corrected; Hairer, Lubich and Wanner, section
/// I.1.4.
template <class Real>
FlowJet<Real> integrate_velocity_verlet(const FlowProblem<Real>& problem,
                                        const VelocityVerletSettings& settings,
                                        IntegrationStatistics& statistics,
                                        const StepObserver<Real>& observer = {});

}  // namespace hamjet
