#pragma once

namespace hamjet {

/// Kahan's compensated addition: `lost` is the sum of what rounding has taken from `value` so far,
/// with opposite sign. With it round-off grows much more slowly over many steps (Hairer, Lubich and
/// Wanner, Geometric Numerical Integration, section VIII.5).
template <class Real>
void add_compensated(Real& value, Real& lost, const Real& increment) {
  const Real corrected = increment - lost;
  const Real sum = value + corrected;
  lost = (sum - value) - corrected;
  value = sum;
}

}  // namespace hamjet
