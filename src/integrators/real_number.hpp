#pragma once

#include <cmath>

namespace hamjet {

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
