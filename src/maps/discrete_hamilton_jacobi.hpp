#pragma once

#include "discrete_generating_function.hpp"
#include "hamjet/detail/dynamics/differentiable_hamiltonian.hpp"

namespace hamjet {

/// The residual of the discrete Hamilton-Jacobi equation at w, a midpoint's variables:
///
///   first kind:   H(q, D1 S(q, Q)) - K(Q, -D2 S(q, Q)),
///   second kind:  H(q, D1 S(q, P)) - K(D2 S(q, P), P).
///
/// The residual vanishes at every w, for every H and K with K o f = H, exactly when S is a discrete
/// generating function of f; in rounded arithmetic round-off divided by existence_measure is left.
/// Unlike the continuous equation this one has no term dS/dt, because one f_k serves both ends of a
/// step. Source: Guibout and Bloch, theorem dhj (in print K(Q, D2 S)); the second kind by the same
/// proof.
template <class Real>
Real hamilton_jacobi_residual(DifferentiableHamiltonian<Real>& original,
                              DifferentiableHamiltonian<Real>& transformed,
                              const DiscreteGeneratingFunction<Real>& generating_function,
                              const Vector<Real>& w);

}  // namespace hamjet
