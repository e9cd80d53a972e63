#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What no program in double precision can promise less than: the error of each component of the
/// final state of the model that half-ulp changes of the initial state and the duration, and the
/// rounding of the result, can cause together; canonical. With u = 2^-53, M the first derivatives,
/// f the vector field at the end and t the duration:
///   u (sum_j |M_ij| |x_j| + |f_i| |t| + |x_i(t)|) .
/// Components that vanish identically have none. The jet is that of `problem`.
std::vector<double> half_ulp_floor(const Scene& scene, const ComputedProblem& problem,
                                   const FlowJet<Extended>& jet);

/// The floor of every entry of the matrix of first derivatives: the largest entry times the largest
/// floor of the state relative to the size of its positions or momenta. Half-ulp changes of the
/// start alone cause less, but what is rounded on the way is amplified by the flow that follows, in
/// the matrix as in the state.
double matrix_floor(const Scene& scene, const ComputedProblem& problem,
                    const FlowJet<Extended>& jet, const std::vector<double>& state_floor);

}  // namespace hamjet
