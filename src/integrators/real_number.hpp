#pragma once

#include <cmath>

namespace hamjet {

// Absolute value and finiteness for double and Extended alike.

template <class Real>
Real magnitude(const Real& x) {
  return x < 0 ? Real(-x) : x;
}

template <class Real>
bool is_finite(const Real& x) {
  using std::isfinite;
  return isfinite(x);
}

}  // namespace hamjet
