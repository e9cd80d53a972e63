#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What no program can promise less than: the errors of a final state and of its first derivatives
/// that half-ulp changes of the initial state and the duration, and the rounding of the result, can
/// cause together.
struct HalfUlpFloor {
  std::vector<double> state;   ///< one a component of the model, canonical
  std::vector<double> matrix;  ///< by rows, 2n x 2n; empty where the jet has no second degree
};

/// With u = 2^-53, M the first derivatives, f the vector field at the end and t the duration:
///   state_i = u (sum_j |M_ij| |x_j| + |f_i| |t| + |x_i(t)|) ,
///   matrix_ij = u (sum_k |d2 x_i / dx_j dx_k| |x_k| + |df_i / dx_j| |t| + |M_ij|) .
/// Components that vanish identically have none. The jet is that of `problem`.
HalfUlpFloor half_ulp_floor(const Scene& scene, const ComputedProblem& problem,
                            const FlowJet<Extended>& jet);

}  // namespace hamjet
