#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

/// How far a one-form is from closed at one degree: the largest coefficient of
///
///   d sigma_i / d w_j - d sigma_j / d w_i
///
/// over all n(2n-1) pairs i < j. It vanishes exactly when the jet is that of a symplectic map.
struct ExactnessResidual {
  int degree = 0;
  double absolute = 0;
  double scaled = 0;  ///< divided by the largest coefficient of d sigma_i / d w_j of this degree
  std::optional<double> at_formation_scale;  ///< the residual if each w_i is in units of its scale
};

/// Residuals of the degrees 0..N-1. `scales` holds a typical deviation for each of the 2n variables
/// w, or is empty. Source: closedness of p dq - p0 dq0; Guibout and Bloch, eq. exactness, corrected
/// (all pairs, and the sign that dS = p dq - p0 dq0 gives).
template <class T>
std::vector<ExactnessResidual> exactness_residual(const std::vector<Series<T>>& one_form,
                                                  std::span<const double> scales = {});

}  // namespace hamjet
