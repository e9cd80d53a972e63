#include "discrete_hamilton_jacobi.hpp"

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

template double hamilton_jacobi_residual(DifferentiableHamiltonian<double>&,
                                         DifferentiableHamiltonian<double>&,
                                         const DiscreteGeneratingFunction<double>&,
                                         const Vector<double>&);
template Extended hamilton_jacobi_residual(DifferentiableHamiltonian<Extended>&,
                                           DifferentiableHamiltonian<Extended>&,
                                           const DiscreteGeneratingFunction<Extended>&,
                                           const Vector<Extended>&);

}  // namespace hamjet
