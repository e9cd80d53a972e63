#pragma once

#include <functional>

#include "transformed_hamiltonian.hpp"

namespace hamjet {

/// A discrete canonical transformation: the map f_k of every instant. It is called with k = 0, 1,
/// 2, ... in this order.
template <class Real>
using CanonicalTransformationSequence = std::function<AffineSymplecticMap<Real>(long k)>;

/// The midpoint scheme in the coordinates Z_k = f_k(z_k) of a discrete canonical transformation.
/// Step k solves
///
///   (Z' - Z_k) / tau = J grad K_k((Z_k + Z')/2),   K_k o f_k = H ,
///
/// in the transformed coordinates alone: both of its ends are images under the same f_k (eq.
/// dct_zdk), so that it ends at Z' = f_k(z_(k+1)), which f_(k+1) f_k^-1 then takes to
/// Z_(k+1) = A_(k+1) A_k^-1 (Z' - B_k) + B_(k+1). Mapping z_(k+1) by f_(k+1) within the step would
/// be another scheme, with another energy error.
///
/// The energy K_k(Z_k) is that of the same scheme in the original coordinates, up to round-off.
/// Source: Guibout and Bloch, sections "Discrete canonical transformation" and "Applications of the
/// discrete Hamilton-Jacobi theory".
template <class Real>
class TransformedMidpoint {
 public:
  /// Starts at f_0(initial). `hamiltonian` is H, in the original coordinates, and must outlive this
  /// object. Throws Error(usage) if the dimensions differ.
  TransformedMidpoint(DifferentiableHamiltonian<Real>& hamiltonian,
                      CanonicalTransformationSequence<Real> transformation,
                      const Vector<Real>& initial, const Real& tau);

  /// Goes on from step k to k + 1. Throws what midpoint_step throws.
  void advance();

  long step() const { return step_; }                            ///< k
  const Vector<Real>& state() const { return state_; }           ///< Z_k
  const AffineSymplecticMap<Real>& map() const { return map_; }  ///< f_k
  Real energy() { return hamiltonian_.value(state_); }           ///< K_k(Z_k)
  /// The transformed Hamiltonian K_k of this step.
  DifferentiableHamiltonian<Real>& hamiltonian() { return hamiltonian_; }

 private:
  CanonicalTransformationSequence<Real> transformation_;
  Real tau_;
  AffineSymplecticMap<Real> map_;
  TransformedHamiltonian<Real> hamiltonian_;
  Vector<Real> state_;
  long step_ = 0;
};

}  // namespace hamjet
