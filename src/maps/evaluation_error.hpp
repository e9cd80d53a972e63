#pragma once

#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// The factor c u of evaluation_error.
double evaluation_rounding(const SeriesSpace& space, int degree);

/// The error that a map of deviations makes when it is evaluated in double precision, given as a
/// map with non-negative coefficients of the magnitudes of the deviations:
///
///   sum over 1 <= |k| <= N of ( c u |a_k| + e_|k| sqrt(A_|k| |a_k|) ) |x|^k ,   u = 2^-53 .
///
/// The first term is rounding, of three kinds: that of the stored coefficients, half an ulp each;
/// that of the evaluation, whose n = terms + N roundings of a sum of products add up to about
/// sqrt(n) u times the sum of the magnitudes (Higham and Mary, A New Approach to Probabilistic
/// Rounding Error Analysis, SIAM J. Sci. Comput. 41 (2019) A2815); and that of converting the
/// deviations from and to other units and axes. The second term is the error of the coefficients
/// themselves, where `error_by_degree` has it: e_d of degree d, relative to A_d, the largest
/// coefficient of the degree in any component. Errors are spread over the monomials somewhere
/// between evenly and as the coefficients are. The error of degree 0, which turns the chief's axes,
/// is left out.
///
/// This is an estimate, not a bound. `map` has no constant terms. Throws Error(usage) for a degree
/// outside 1 to the map's order.
std::vector<Series<double>> evaluation_error(const std::vector<Series<double>>& map, int degree,
                                             std::span<const double> error_by_degree = {});

}  // namespace hamjet
