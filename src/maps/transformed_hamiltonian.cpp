#include "transformed_hamiltonian.hpp"

#include "../algebra/instantiated_real.hpp"

namespace hamjet {
template <class Real>
TransformedHamiltonian<Real>::TransformedHamiltonian(DifferentiableHamiltonian<Real>& original,
                                                     const AffineSymplecticMap<Real>& map)
    : original_(&original) {
  set_map(map);
}

template <class Real>
void TransformedHamiltonian<Real>::set_map(const AffineSymplecticMap<Real>& map) {
  detail::require_same_dimension(dimension(), map.dimension());
  inverse_ = map.inverse_matrix();
  shift_ = map.shift();
}

template <class Real>
Real TransformedHamiltonian<Real>::value(const Vector<Real>& Z) {
  return original_->value(inverse_ * (Z - shift_));
}

template <class Real>
const HamiltonianDerivatives<Real>& TransformedHamiltonian<Real>::derivatives(
    const Vector<Real>& Z) {
  const auto& original = original_->derivatives(inverse_ * (Z - shift_));
  derivatives_.gradient = inverse_.transpose() * original.gradient;
  derivatives_.hessian = inverse_.transpose() * original.hessian * inverse_;
  return derivatives_;
}

template class TransformedHamiltonian<InstantiatedReal>;

}  // namespace hamjet
