#pragma once

#include "hamjet/detail/dynamics/differentiable_hamiltonian.hpp"

namespace hamjet {

/// One step of the midpoint scheme,
///
///   (z' - z) / tau = J grad H((z + z')/2) ,
///
/// for a Hamiltonian that may change from step to step. (For the jet of one system's flow, use
/// integrate_gauss with one stage, which is the same scheme.) The equation is solved by Newton's
/// method with the exact Jacobian I - (tau/2) J H'' on the increment z' - z, to round-off. tau may
/// have either sign, and a step of -tau takes z' back to z.
///
/// Throws Error(usage) if the sizes differ; Error(numerical) if an evaluation is not finite, if the
/// determinant of that Jacobian, which is 1 for tau = 0, is not positive, or if the iteration does
/// not converge; then the step is too long for the solution that continues its start. Iterates and
/// determinant are the same in all canonical coordinates, up to round-off.
///
/// Source: Guibout and Bloch, section "Midpoint rule", with the operator (R_(tau/2) - R_(-tau/2)) /
/// tau: in print the division is missing, and so is q on the left of the first of Hamilton's
/// equations.
template <class Real>
Vector<Real> midpoint_step(DifferentiableHamiltonian<Real>& hamiltonian, const Vector<Real>& z,
                           const Real& tau);

}  // namespace hamjet
