#pragma once

#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// What is lost where a map of deviations is evaluated in double precision, as a map with
/// non-negative coefficients in the magnitudes of the deviations:
///
///   sum over 1 <= |k| <= N of ( c u |a_k| + e_|k| A_|k| ) |x|^k ,   u = 2^-53 .
///
/// The first term is rounding: of the stored coefficients, half an ulp each; of the evaluation,
/// whose n = terms + N roundings of a sum of products add up to about sqrt(n) u times the sum of
/// the magnitudes (Higham and Mary, A New Approach to Probabilistic Rounding Error Analysis, SIAM
/// J. Sci. Comput. 41 (2019) A2815); and of the deviations, given in other units and axes, there
/// and back. The second is the error of the coefficients themselves, where `error_by_degree` has
/// it: e_d of degree d relative to A_d, the largest coefficient of the degree in any component.
/// That of degree 0, which turns axes that are the chief's, is no part of it.
///
/// This is an estimate, not a bound. `map` has no constant terms. Throws Error(usage) for a degree
/// outside 1 to the map's order.
std::vector<Series<double>> evaluation_error(const std::vector<Series<double>>& map, int degree,
                                             std::span<const double> error_by_degree = {});

}  // namespace hamjet
