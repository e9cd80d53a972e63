#pragma once

#include <cmath>

#include "hamjet/algebra/extended.hpp"

namespace hamjet::test {

inline double magnitude_of(const Extended& x) { return std::abs(static_cast<double>(x)); }

/// The larger of two numbers; a NaN is larger than any.
inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

}  // namespace hamjet::test
