#pragma once

#include <cmath>
#include <limits>

namespace hamjet {

/// A number of binary64 that died out below this one has no digits of its own: what a jet that
/// contracts leaves of deviations.
inline constexpr double least_with_digits =
    std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();

// Absolute values and finiteness for double and Extended alike.

template <class Real>
Real magnitude(const Real& x) {
  return x < 0 ? Real(-x) : x;
}

/// The larger of a, which is not negative, and |b|.
template <class Real>
Real larger_magnitude(const Real& a, const Real& b) {
  const Real size = magnitude(b);
  return a < size ? size : a;
}

template <class Real>
bool is_finite(const Real& x) {
  using std::isfinite;
  return isfinite(x);
}

}  // namespace hamjet
