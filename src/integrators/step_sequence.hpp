#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamjet/error.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The step h, adapted to the rest of the duration: the last steps share the rest, so that none is
/// tiny.
template <class Real>
Real fit_to_span(const Real& h, const Real& remaining) {
  const double ratio = static_cast<double>(Real(remaining / h));
  if (ratio <= 1) return remaining;
  return ratio < 2 ? Real(remaining / 2) : h;
}

[[noreturn]] inline void refuse_step_count(const char* method, double count) {
  throw Error(ErrorKind::too_large,
              fmt::format("{}: about {:.3g} steps would be needed, at most {:.0e} are taken; a "
                          "shorter duration or a larger step or tolerance would do",
                          method, count, largest_step_count));
}

/// Number of equal steps not longer than `step` that fill a duration. A step that divides the
/// duration up to round-off counts as dividing it. Throws Error(too_large) for too many steps.
template <class Real>
long equal_step_count(const Real& duration, double step, const char* method) {
  const double count = std::ceil(std::abs(static_cast<double>(duration)) / step * (1 - 1e-12));
  if (!(count <= largest_step_count)) refuse_step_count(method, count);
  return std::max(1L, static_cast<long>(count));
}

/// Throws Error(too_large) if the number of steps so far suggests too many in all. The steps of
/// orbits grow and shrink, so that the first thousands are not judged.
inline void limit_step_count(const char* method, long steps, double time, double duration) {
  constexpr long trusted = 2000;
  if (steps < trusted) return;
  const double expected = static_cast<double>(steps) * std::abs(duration / time);
  if (!(expected <= largest_step_count)) refuse_step_count(method, expected);
}

}  // namespace hamjet
