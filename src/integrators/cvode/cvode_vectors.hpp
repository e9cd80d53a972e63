#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>

#include <Eigen/Core>
#include <cmath>

#include "cvode_handles.hpp"

// Operations on CVODE's vectors. Those of SUNDIALS, as distributions compile it, take numbers one
// by one, and were 57 % of the paper's comparison.

namespace hamjet::sundials {

inline Eigen::Map<Eigen::ArrayXd> array_of(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v))};
}

/// z = a x + b y.
inline void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  array_of(z) = a * array_of(x) + b * array_of(y);
}

/// The root of the mean of (x_i w_i)^2.
inline realtype weighted_norm(N_Vector x, N_Vector w) {
  return std::sqrt((array_of(x) * array_of(w)).square().mean());
}

/// A serial vector whose clones, which CVODE makes, have these operations too.
inline Vector make_vector(sunindextype length, SUNContext context) {
  Vector v(require(N_VNew_Serial(length, context)));
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvwrmsnorm = weighted_norm;
  return v;
}

/// The weights 1 / (tolerance |y| + tolerance) of errors, as of CVodeSStolerances; `tolerance`
/// points to a double.
inline void set_weights(N_Vector y, N_Vector weights, double tolerance) {
  array_of(weights) = (tolerance * array_of(y).abs() + tolerance).inverse();
}

}  // namespace hamjet::sundials
