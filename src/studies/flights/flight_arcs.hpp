#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A step of the flights of some spacecraft side by side. Throughout the step its polynomials leave
/// out no more than rounding, so that nothing is missed between two evaluations.
struct FlightArc {
  double start = 0;  ///< in the time that the caller counts, canonical
  double span = 0;   ///< duration, negative backwards
  /// For each spacecraft, the components (q, p) as series in the fraction of the span that has
  /// passed.
  std::vector<std::vector<Series<double>>> spacecraft;

  double time_at(double share) const { return start + share * span; }
  /// The state of one spacecraft at a fraction from 0 to 1 of the span.
  std::vector<double> state(std::size_t craft, double share) const;
};

/// The value of a series in one variable.
double value_at(const Series<double>& series, double share);

/// Flies the states (q, p) over a time, which may be negative, by Taylor's method in steps that all
/// of them can take, and hands each arc to the caller. All stand at `start_time` of the system's
/// clock; the arcs count their times from `since`. A time of 0 gives one arc. Returns the states at
/// the end. Throws Error(numerical) if one runs into a collision.
std::vector<std::vector<double>> fly_arcs(const SharedSystem& system,
                                          std::vector<std::vector<double>> states,
                                          const ClockTime& start_time, double time,
                                          const std::function<void(const FlightArc&)>& on_arc,
                                          double since = 0);

}  // namespace hamjet
