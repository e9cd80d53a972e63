#pragma once

#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// How far a jet is from symplectic at one degree: the largest coefficient of {z_i, z_j} - J_ij
/// over all pairs i < j.
struct SymplecticityDefect {
  int degree = 0;
  double absolute = 0;
  /// The absolute defect divided by the largest sum of absolute values of the terms of a
  /// coefficient of this degree. The quotient is not formed for each coefficient by itself: where
  /// symmetry makes a coefficient vanish, it would be a ratio of two round-off errors.
  double scaled = 0;
};

/// Defects of the degrees 0..N-1 of a jet of 2n components in all 2n initial deviations. No
/// inversion is needed, so that no round-off is amplified: the scaled defect of a symplectic method
/// stays at the rounding of the jet's numbers at every degree. For a jet in double precision the
/// brackets are formed in extended precision, so that the defect shows the jet's own rounding
/// alone. Throws Error(usage) for other sizes.
template <class T>
std::vector<SymplecticityDefect> symplecticity_by_degree(const std::vector<Series<T>>& jet);

}  // namespace hamjet
