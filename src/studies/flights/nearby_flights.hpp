#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// exact_flow for many states near one orbit. Where short waves of the field make Gauss's method
/// try the tolerance of its steps, which takes longer than the flight itself, this is done for the
/// first flight, and again for one that is longer than any before; the others take the tolerance
/// that was found. An object is for one thread.
class NearbyFlights {
 public:
  explicit NearbyFlights(SharedSystem system) : system_(std::move(system)) {}

  /// Tries the tolerance on the flight of a state, for all flights that are no longer.
  void try_tolerance(const std::vector<double>& start, const ClockTime& start_time,
                     double duration);

  /// As exact_flow.
  std::vector<double> end(const std::vector<double>& start, const ClockTime& start_time,
                          double duration);

  /// The flow about the flight of a state to first order in all of its coordinates, with the steps
  /// that suit the flight itself.
  FlowJet<double> linear_end(const std::vector<double>& start, const ClockTime& start_time,
                             double duration);

 private:
  SharedSystem system_;
  std::optional<double> step_tolerance_;
  double tried_ = 0;  ///< length of the flight for which it was found
};

}  // namespace hamjet
