#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A step of the flights of some spacecraft side by side. Its polynomials leave out no more than
/// rounding anywhere in it, so that nothing can hide between two looks.
struct FlightArc {
  double start = 0;  ///< canonical time
  double span = 0;   ///< of time, negative backwards
  /// Of each spacecraft the components (q, p) as series in the share of the span that has passed.
  std::vector<std::vector<Series<double>>> spacecraft;

  double time_at(double share) const { return start + share * span; }
  /// The state of one of them at a share from 0 to 1 of the span.
  std::vector<double> state(std::size_t craft, double share) const;
};

/// The value of a series in one variable.
double value_at(const Series<double>& series, double share);

/// Flies the states (q, p) over a time, which may be negative, by Taylor's method in steps that all
/// of them can take, and tells each; the flight's clock shows `start` at first. A time of 0 is one
/// arc. Returns the states at the end. Throws Error(numerical) where one runs into a collision.
std::vector<std::vector<double>> fly_arcs(const SharedSystem& system,
                                          std::vector<std::vector<double>> states, double start,
                                          double time,
                                          const std::function<void(const FlightArc&)>& on_arc);

}  // namespace hamjet
