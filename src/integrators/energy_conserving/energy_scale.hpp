#pragma once

#include <vector>

#include "../real_number.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"

namespace hamjet {

/// The size of the terms of a Hamiltonian's value, by which round-off is judged: the energy itself
/// and each variable times its derivative. `hamiltonian` must have been evaluated at z.
template <class Real>
Real energy_scale(const DifferentiableFunction<Real>& hamiltonian, const std::vector<Real>& z) {
  Real scale = magnitude(hamiltonian.value(0));
  for (std::size_t i = 0; i < z.size(); ++i) {
    scale += magnitude(Real(hamiltonian.derivative(0, i) * z[i]));
  }
  return scale;
}

}  // namespace hamjet
