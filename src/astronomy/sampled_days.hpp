#pragma once

#include <functional>

#include "hamjet/astronomy/instant.hpp"
#include "piecewise_hermite.hpp"

namespace hamjet {

/// Components of a function of TT, at two parts of a Julian date, to be written to `out`.
using FunctionOfDate = std::function<void(double day, double fraction, double* out)>;

/// A smooth function of TT sampled every quarter of a day and interpolated, for times from `first`
/// to `last` in `unit_s`, counted from an epoch, and a quarter of a day beyond. A term of 5 days is
/// met to 1e-11 of its size, one of a month to 1e-16.
PiecewiseHermite sampled_days(const Instant& epoch, const Extended& unit_s, double first,
                              double last, std::size_t components, const FunctionOfDate& function);

/// The distance beyond the span up to which such a function is good, in days.
inline constexpr double days_beyond_span = 0.25;

/// Throws Error(numerical) for a time outside the span, which goes on for days_beyond_span.
void require_within_span(double t, double first, double last, double unit_s);

}  // namespace hamjet
