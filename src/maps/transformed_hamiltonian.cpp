#include "transformed_hamiltonian.hpp"

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

void require_same_dimension(Eigen::Index hamiltonian, Eigen::Index map) {
  if (hamiltonian != map) {
    throw Error(ErrorKind::usage,
                "transformed Hamiltonian: the map has another number of variables");
  }
}

}  // namespace

template <class Real>
TransformedHamiltonian<Real>::TransformedHamiltonian(DifferentiableHamiltonian<Real>& original,
                                                     const AffineSymplecticMap<Real>& map)
    : original_(&original) {
  set_map(map);
}

template <class Real>
void TransformedHamiltonian<Real>::set_map(const AffineSymplecticMap<Real>& map) {
  require_same_dimension(dimension(), map.dimension());
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

DynamicalSystem transformed_system(const DynamicalSystem& system,
                                   const AffineSymplecticMap<Extended>& map) {
  require_same_dimension(static_cast<Eigen::Index>(system.dimension()), map.dimension());
  const AffineSymplecticMap<Extended> inverse = map.inverse();
  const auto hamiltonian = record(system.dimension(), [&](std::span<const Expression> Z) {
    std::vector<Expression> z;
    for (Eigen::Index i = 0; i < inverse.dimension(); ++i) {
      Expression sum(inverse.shift()(i));
      for (Eigen::Index j = 0; j < inverse.dimension(); ++j) {
        sum += Expression(inverse.matrix()(i, j)) * Z[static_cast<std::size_t>(j)];
      }
      z.push_back(sum);
    }
    return recorded_outputs(system.hamiltonian, z);
  });
  return make_system(system.name + ", transformed", hamiltonian);
}

template class TransformedHamiltonian<double>;
template class TransformedHamiltonian<Extended>;

}  // namespace hamjet
