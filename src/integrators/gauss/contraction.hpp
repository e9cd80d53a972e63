#pragma once

#include <limits>

#include "../real_number.hpp"
#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// Follows the changes of a fixed-point iteration, relative to the size of the iterate.
template <class Real>
class Contraction {
 public:
  enum Outcome {
    goes_on,
    converged,    ///< all further changes add up to less than the allowed remainder
    is_rounding,  ///< in addition, the last change was rounding alone
    fails
  };

  /// The allowed remainder, as a fraction of a rounding error. The remainder has the same sign in
  /// every step, so that half a rounding error would make the energy drift (Hairer, McLachlan and
  /// Razakarivony, BIT 48 (2008) 231).
  static constexpr double largest_remainder = 0x1p-12;

  /// `contracts_once_more` says that the use of the result contracts the remainder once more.
  explicit Contraction(bool contracts_once_more = false)
      : contracts_once_more_(contracts_once_more) {}

  Outcome judge(const Real& size) {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    const Real before = previous_;
    previous_ = size;
    if (size == 0 && count_ > 0) return is_rounding;
    if (!(size <= before * slowest)) {
      // Changes that no longer shrink are rounding, provided that they are as small as rounding.
      if (size <= 2 * epsilon) return is_rounding;
      if (++stalls_ > most_stalls) return fails;
    } else if (count_ > 0) {
      // By the contraction of this iteration, all further changes add up to size^2 / (before -
      // size).
      const Real left = contracts_once_more_ ? Real(size * Real(size / before)) : size;
      if (left * size <= largest_remainder * epsilon * (before - size)) return converged;
    }
    return ++count_ < largest_count ? goes_on : fails;
  }

 private:
  static constexpr double slowest = 0.5;
  static constexpr int most_stalls = 1;  ///< the first changes may grow
  static constexpr int largest_count = 40;
  bool contracts_once_more_;
  int count_ = 0;
  int stalls_ = 0;
  Real previous_ = std::numeric_limits<Real>::max();  ///< no change yet
};

/// The inverse of the largest magnitude in the lanes of two packs, relative to which changes count;
/// zero if both vanish.
template <class Real, int Lanes>
Pack<Real, Lanes> inverse_scale(const Pack<Real, Lanes>& a, const Pack<Real, Lanes>& b) {
  const Real scale =
      largest_magnitude(larger_magnitude(larger_magnitude(Pack<Real, Lanes>(Real(0)), a), b));
  return Pack<Real, Lanes>(scale > 0 ? Real(1 / scale) : Real(0));
}

/// Whether all numbers are finite. The changes of an iteration do not show a NaN, because the
/// machine's maximum skips it.
template <class Packs>
bool are_finite(const Packs& packs) {
  for (const auto& pack : packs) {
    if (!is_finite(largest_magnitude(pack))) return false;
  }
  return true;
}

}  // namespace hamjet
