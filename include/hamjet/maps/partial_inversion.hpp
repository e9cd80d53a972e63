#pragma once

#include <limits>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/detail/maps/generating_function_kind.hpp"

namespace hamjet {

/// A jet solved for the variables that a generating function does not take.
///
/// The 2n variables w are the chosen final ones (w_1..w_n, one per degree of freedom), then the
/// chosen initial ones (w_(n+1)..w_2n); all are deviations from the nominal.
template <class T>
struct PartialInversion {
  GeneratingFunctionKind kind;
  double condition = 0;  ///< condition number of the inverted matrix in the 2-norm
  /// Factor by which relative errors of the map's linear part may grow in the inverse: the larger
  /// of the condition and the ratio of the whole linear part's norm to the smallest singular value
  /// of the inverted matrix.
  double amplification = 0;
  std::vector<Series<T>> remaining_final;    ///< n series in w
  std::vector<Series<T>> remaining_initial;  ///< n series in w
};

/// The linear part that a kind inverts: d(chosen final) / d(remaining initial), n x n. For F1 it is
/// dq/dp0, for F2 dq/dq0, for F3 dp/dp0, for F4 dp/dq0. Momenta are in units of
/// 2^momentum_exponent, because a mixed kind has rows of positions and rows of momenta, and its
/// condition number depends on their units.
template <class T>
Matrix<T> inverted_block(const std::vector<Series<T>>& jet, const GeneratingFunctionKind& kind,
                         int momentum_exponent = 0);

/// Condition number in the 2-norm: ratio of the largest to the smallest singular value; infinite
/// for a singular matrix.
template <class T>
double condition_number(const Matrix<T>& matrix);

/// Beyond this condition number a linear part that is known to a relative precision counts as
/// singular. A matrix of rounded numbers is never exactly singular: at a full period of Kepler's
/// problem, F1 has a condition near 3e17 in double precision.
constexpr double largest_condition(double precision) { return 1 / (100 * precision); }

/// Inverts a jet of 2n components in all 2n initial deviations; its constant terms are ignored.
/// `precision` is the rounding of the jet's coefficients, which may be coarser than that of T.
/// Throws Error(numerical), naming kind and smallest singular value, where the condition exceeds
/// largest_condition(precision), or where the inverted block is smaller than the whole linear part
/// by that factor (with one degree of freedom the condition is always 1). The generating function
/// does not exist there to any useful accuracy. Both are judged with momenta in units of
/// 2^momentum_exponent; the series are in the jet's own units. Throws Error(usage) if the jet is
/// not 2n components in 2n variables.
template <class T>
PartialInversion<T> invert_partially(
    const std::vector<Series<T>>& jet, const GeneratingFunctionKind& kind,
    double precision = static_cast<double>(std::numeric_limits<T>::epsilon()),
    int momentum_exponent = 0);

/// The kind whose linear part has the smallest condition number. Among kinds of equal condition (to
/// a part in a million) it is the one with the largest singular values, because with one degree of
/// freedom all conditions are 1. `momentum_exponent` is as in inverted_block.
template <class T>
GeneratingFunctionKind best_conditioned_kind(const std::vector<Series<T>>& jet,
                                             int momentum_exponent = 0);

}  // namespace hamjet
