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
  /// coefficient of this degree; not coefficient by coefficient, for where symmetry makes
  /// coefficients vanish both would be round-off alone.
  double scaled = 0;
};

/// Defects of the degrees 0..N-1 of a jet of 2n components in all 2n initial deviations. It needs
/// no inversion and so amplifies no round-off: scaled, a symplectic method stays at the rounding of
/// the jet's numbers at every degree. For numbers of double precision the brackets are formed in
/// extended precision, so that what is seen is the jet's own rounding. Throws Error(usage) for
/// other sizes.
template <class T>
std::vector<SymplecticityDefect> symplecticity_by_degree(const std::vector<Series<T>>& jet);

}  // namespace hamjet
