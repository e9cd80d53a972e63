#pragma once

#include "affine_symplectic_map.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/differentiable_hamiltonian.hpp"

namespace hamjet {

namespace detail {
/// Throws Error(usage) unless a Hamiltonian and a map have the same number of variables.
void require_same_dimension(Eigen::Index hamiltonian, Eigen::Index map);
}  // namespace detail

/// The Hamiltonian K in the coordinates Z = A z + B of an affine canonical transformation f:
/// K o f = H, that is K(Z) = H(A^-1 (Z - B)), with
///
///   grad K(Z) = A^-T grad H(z),   K''(Z) = A^-T H''(z) A^-1 .
///
/// There is no term of dS/dt: one f serves both ends of a step. Source: Guibout and Bloch, section
/// "Discrete canonical transformation" (K_d o f = H_d; grad K_d is taken at Z^d, in print at z^d).
template <class Real>
class TransformedHamiltonian final : public DifferentiableHamiltonian<Real> {
 public:
  /// `original` must outlive this object. Throws Error(usage) if the dimensions differ.
  TransformedHamiltonian(DifferentiableHamiltonian<Real>& original,
                         const AffineSymplecticMap<Real>& map);

  /// Changes to another transformation of the same Hamiltonian.
  void set_map(const AffineSymplecticMap<Real>& map);

  Eigen::Index dimension() const override { return original_->dimension(); }
  Real value(const Vector<Real>& Z) override;
  const HamiltonianDerivatives<Real>& derivatives(const Vector<Real>& Z) override;

 private:
  DifferentiableHamiltonian<Real>* original_;
  Matrix<Real> inverse_;
  Vector<Real> shift_;
  HamiltonianDerivatives<Real> derivatives_;
};

/// The transformed Hamiltonian K as a recorded system, for integrators that take a DynamicalSystem.
/// Throws Error(usage) if the dimensions differ.
DynamicalSystem transformed_system(const DynamicalSystem& system,
                                   const AffineSymplecticMap<Extended>& map);

}  // namespace hamjet
