#pragma once

#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Settings of a symmetric composition of velocity Verlet.
struct SymmetricCompositionSettings {
  int order = 4;  ///< 4, 6 or 8, with 5, 9 or 17 substeps
  /// Longest step of the whole composition, in the system's unit of time, positive; the duration is
  /// divided into equal steps.
  double step = 0;
};

/// The substeps gamma_1, ..., gamma_s of the composition of an order, as fractions of the step:
///
///   Phi_h = Verlet_(gamma_s h) o ... o Verlet_(gamma_1 h),   gamma_(s+1-k) = gamma_k .
///
/// Order 4: Suzuki (1990), 5 substeps, gamma_1 = 1/(4 - 4^(1/3)). Orders 6 and 8: Kahan and Li
/// (1997), 9 and 17 substeps. The substeps are right to all digits of Extended: the order
/// conditions hold to its rounding. Throws Error(usage) for another order.
std::vector<Extended> composition_substeps(int order);

/// Integrates the flow's jet with a symmetric composition of velocity Verlet, applied exactly to
/// series. The method is explicit, symmetric and symplectic. It needs a system with a second-order
/// form q' = M^-1 p, p' = F(q) (DynamicalSystem::second_order). It takes one evaluation on series
/// per substep, plus one at the start. Some substeps go backwards; the largest are 0.8 of a step.
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. The
/// update is summed with compensation. If the nominal steps over a collision, this is not noticed.
///
/// Sources: M. Suzuki, Phys. Lett. A 146 (1990) 319; W. Kahan and R.-C. Li, Math. Comp. 66 (1997)
/// 1089; Hairer, Lubich and Wanner, Geometric Numerical Integration, section V.3.2. Throws
/// Error(usage) for another order, a step that is not positive and a system without second-order
/// form, Error(too_large) for more than 1e8 steps, Error(numerical), naming time and step, if the
/// force or a coefficient is not finite.
template <class Real>
FlowJet<Real> integrate_symmetric_composition(const FlowProblem<Real>& problem,
                                              const SymmetricCompositionSettings& settings,
                                              IntegrationStatistics& statistics,
                                              const StepObserver<Real>& observer = {});

}  // namespace hamjet
