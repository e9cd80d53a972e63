#pragma once

#include <fmt/format.h>

#include <limits>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// The value of a rising function at a place, and its slope there.
struct MissAndSlope {
  Extended miss;
  Extended slope;
};

/// The root of a rising function between `low` and `high`, by Newton's method from `guess`. Where a
/// step would leave the bracket, the bracket is halved instead. `miss_at` gives MissAndSlope at a
/// place. Throws Error(numerical) if a value is NaN, or if 200 steps do not find the root.
template <class Function>
Extended root_in_bracket(const Function& miss_at, Extended low, Extended high, Extended guess) {
  // Halving alone gains one bit per step; Newton's method needs some ten steps.
  constexpr int most_steps = 200;
  Extended last_miss = 0, at_guess = guess;
  for (int i = 0; i < most_steps; ++i) {
    const MissAndSlope at = miss_at(guess);
    last_miss = at.miss;
    // With a NaN, halving would run to an end of the bracket and take that end for the root.
    if (!isfinite(at.miss)) break;
    at_guess = guess;
    (at.miss > 0 ? high : low) = guess;
    Extended next = guess - at.miss / at.slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const bool is_found =
        next == guess ||
        abs(next - guess) <= 4 * std::numeric_limits<Extended>::epsilon() * (1 + abs(guess));
    guess = next;
    if (is_found) return guess;
  }
  // Where the slope is small, the rounding of the function moves the place back and forth by more
  // than the last digit. The function is a sum of three terms no larger than about the place, each
  // rounded a few times.
  const Extended rounding = 16 * std::numeric_limits<Extended>::epsilon() * (1 + abs(at_guess));
  if (abs(last_miss) <= rounding) return at_guess;
  throw Error(ErrorKind::numerical,
              fmt::format("Kepler's equation: no root is found between {:.6g} and {:.6g}",
                          static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace hamjet
