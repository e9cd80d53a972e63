#include "discrete_hamilton_jacobi.hpp"

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet {

template <class Real>
Real hamilton_jacobi_residual(DifferentiableHamiltonian<Real>& original,
                              DifferentiableHamiltonian<Real>& transformed,
                              const DiscreteGeneratingFunction<Real>& generating_function,
                              const Vector<Real>& w) {
  return original.value(generating_function.original_point(w)) -
         transformed.value(generating_function.transformed_point(w));
}

template InstantiatedReal hamilton_jacobi_residual(
    DifferentiableHamiltonian<InstantiatedReal>&, DifferentiableHamiltonian<InstantiatedReal>&,
    const DiscreteGeneratingFunction<InstantiatedReal>&, const Vector<InstantiatedReal>&);

}  // namespace hamjet
