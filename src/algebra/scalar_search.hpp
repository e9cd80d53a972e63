#pragma once

#include <fmt/format.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "hamjet/error.hpp"

// Searches along a line by Boost's routines. These return whatever they hold when their evaluations
// are used up, or when the function is NaN; the functions here check for both and throw.

namespace hamjet {

/// A place, and the value of the function there.
struct PlaceAndValue {
  double place = 0;
  double value = 0;
};

/// The root of a continuous function between two places, given in either order, at which the
/// function has different signs or is zero. The root is found to this number of bits of the place,
/// by Alefeld, Potra and Shi's Algorithm 748. `what` names the search in messages. Throws
/// Error(numerical) if both signs are the same, if a value is not finite, or if the root is not
/// found within the number of evaluations.
template <class Function>
double root_between(std::string_view what, const Function& function, PlaceAndValue a,
                    PlaceAndValue b, int bits, std::uintmax_t most_evaluations = 200) {
  const auto finite = [&](double place, double value) {
    if (std::isfinite(value)) return value;
    throw Error(
        ErrorKind::numerical,
        fmt::format("{}: the function whose root is sought is {} at {:.10g}", what, value, place));
  };
  finite(a.place, a.value);
  finite(b.place, b.value);
  if (a.value == 0) return a.place;
  if (b.value == 0) return b.place;
  if ((a.value < 0) == (b.value < 0)) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: no root is enclosed, got {:.3g} at {:.10g} and {:.3g} at {:.10g}",
                            what, a.value, a.place, b.value, b.place));
  }
  if (b.place < a.place) std::swap(a, b);
  std::uintmax_t evaluations = most_evaluations;
  const auto [low, high] = boost::math::tools::toms748_solve(
      [&](double place) { return finite(place, function(place)); }, a.place, b.place, a.value,
      b.value, boost::math::tools::eps_tolerance<double>(bits), evaluations);
  // Where the place is 0 itself, no bits of the bracket's ends agree, and the bracket shrinks to
  // nothing.
  const bool is_found = boost::math::tools::eps_tolerance<double>(bits)(low, high) ||
                        high - low <= std::ldexp(b.place - a.place, -bits);
  if (!is_found) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: {} evaluations leave the root between {:.10g} and {:.10g}", what,
                            evaluations, low, high));
  }
  return low + (high - low) / 2;
}

/// The place and value of a minimum between two places, by Brent's method, to this number of bits
/// of the place (no more than half of the digits, for a function is flat at its minimum). Where the
/// function has several minima, or the evaluations are used up, the lowest place that was found is
/// returned. Throws Error(numerical) if a value is NaN.
template <class Function>
PlaceAndValue minimum_between(std::string_view what, const Function& function, double a, double b,
                              int bits, std::uintmax_t most_evaluations = 100) {
  if (b < a) std::swap(a, b);
  const auto [place, value] = boost::math::tools::brent_find_minima(
      [&](double at) {
        const double found = function(at);
        if (std::isnan(found)) {
          throw Error(
              ErrorKind::numerical,
              fmt::format("{}: the function whose minimum is sought is no number at {:.10g}", what,
                          at));
        }
        return found;
      },
      a, b, bits, most_evaluations);
  return {place, value};
}

}  // namespace hamjet
