#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../../studies/uncertainty/uncertainty.hpp"

namespace hamjet::io {

/// Numbers with the lengths of their dimensions, the last one running fastest.
struct NumberArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<double> numbers;
};

/// Moments as arrays: `mean`, `standard_deviation`, `skewness`, `excess_kurtosis` (6 each),
/// `covariance` (6, 6), `mardia_skewness`, `mardia_excess_kurtosis` and `negentropy`.
std::vector<NumberArray> moments_arrays(const Cumulants& moments);

/// A study's moments as arrays, T times, S states, N orders: those of moments_arrays behind the
/// dimensions (T, S, N) of Cartesian polynomials; behind `charted_` of the scene's other
/// coordinates, NaN without such; behind `flown_`, of (T, S), those of the samples, and behind
/// `flown_`, with `_scatter` after, what they scatter by; `times_s` (T) and
/// `linear_error_of_probability` (T, S).
std::vector<NumberArray> uncertainty_arrays(const UncertaintyResult& result);

}  // namespace hamjet::io
