#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

// Explicit symplectic methods for a system with a second-order form q' = M^-1 p, p' = F(q)
// (DynamicalSystem::second_order). Each method is applied exactly to series. The result is the jet
// of the numerical map, which is symplectic, so that its generating functions exist to round-off
// for any step (but exactness is not accuracy).

/// Settings of Störmer's rule.
struct StormerSettings {
  /// Longest step, in the system's unit of time, positive; the duration is divided into equal
  /// steps.
  double step = 0;
};

/// Settings of velocity Verlet.
struct VelocityVerletSettings {
  /// Longest step, in the system's unit of time, positive; the duration is divided into equal
  /// steps.
  double step = 0;
};

/// Integrates the flow's jet with Störmer's rule in the paper's Hamiltonian form, where p_k is
/// taken at t_k:
///
///   p_(k+1) = p_k + h F(q_k),   q_(k+1) = q_k + h M^-1 p_(k+1) .
///
/// This is the symplectic Euler method. It has order 1 and is not symmetric, so that a run forwards
/// followed by one backwards does not return. It takes one evaluation on series per step.
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. The
/// update is summed with compensation. If the nominal steps over a collision, this is not noticed.
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
/// The method has order 2, is symmetric and takes one evaluation on series per step, plus one at
/// the start, because the force at the end of a step is that at the start of the next. Limits,
/// errors and summation are those of integrate_stormer.
///
/// Source: Guibout and Bloch, eq. `legendre_vv`, corrected; Hairer, Lubich and Wanner, section
/// I.1.4.
template <class Real>
FlowJet<Real> integrate_velocity_verlet(const FlowProblem<Real>& problem,
                                        const VelocityVerletSettings& settings,
                                        IntegrationStatistics& statistics,
                                        const StepObserver<Real>& observer = {});

}  // namespace hamjet
