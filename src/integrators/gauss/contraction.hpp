#pragma once

#include <limits>

#include "../real_number.hpp"
#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// Follows the sizes of the changes of a fixed-point iteration, relative to what changes.
template <class Real>
class Contraction {
 public:
  enum Outcome {
    goes_on,
    converged,    ///< all changes to come add up to less than may be left
    is_rounding,  ///< and the last change too was rounding alone
    fails
  };

  /// The part of a rounding that may be left: it has the same sign in every step, so that half a
  /// rounding would make the energy drift (Hairer, McLachlan and Razakarivony, BIT 48 (2008) 231).
  static constexpr double largest_remainder = 0x1p-12;

  /// What the iteration is for may contract what is left once more.
  explicit Contraction(bool contracts_once_more = false)
      : contracts_once_more_(contracts_once_more) {}

  Outcome judge(const Real& size) {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    const Real before = previous_;
    previous_ = size;
    if (size == 0 && count_ > 0) return is_rounding;
    if (!(size <= before * slowest)) {
      // Changes that no longer shrink are rounding, if they are no larger than that.
      if (size <= 2 * epsilon) return is_rounding;
      if (++stalls_ > most_stalls) return fails;
    } else if (count_ > 0) {
      // All changes to come add up to size^2 / (before - size), by the contraction of this one.
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
  Real previous_ = std::numeric_limits<Real>::max();  ///< none yet
};

/// The inverse of the largest magnitude of the lanes of two packs, which changes count relative to;
/// zero where both vanish.
template <class Real, int Lanes>
Pack<Real, Lanes> inverse_scale(const Pack<Real, Lanes>& a, const Pack<Real, Lanes>& b) {
  const Real scale =
      largest_magnitude(larger_magnitude(larger_magnitude(Pack<Real, Lanes>(Real(0)), a), b));
  return Pack<Real, Lanes>(scale > 0 ? Real(1 / scale) : Real(0));
}

/// Whether all numbers are finite; the changes of an iteration do not show a NaN, which the
/// machine's maximum skips.
template <class Packs>
bool are_finite(const Packs& packs) {
  for (const auto& pack : packs) {
    if (!is_finite(largest_magnitude(pack))) return false;
  }
  return true;
}

}  // namespace hamjet
