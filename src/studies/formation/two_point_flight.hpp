#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The position and the momentum of a state (q, p).
inline Eigen::Vector3d position_of(const std::vector<double>& z) { return {z[0], z[1], z[2]}; }
inline Eigen::Vector3d momentum_of(const std::vector<double>& z) { return {z[3], z[4], z[5]}; }

/// A flight from one position to another in a given time, in canonical units.
struct TwoPointFlight {
  std::vector<double> start;  ///< state (q, p) after the impulse at the start
  std::vector<double> end;    ///< state at the end
  double miss = 0;            ///< distance of this state from the wanted position
  int flights = 0;
  std::string failure;  ///< if not empty, the reason why the wanted position was not reached

  bool is_found() const { return failure.empty(); }
};

/// Newton's method on flown trajectories, with the linear part of the flow about each. The velocity
/// at the start of `guess`, which stands at `start_time` of the system's clock, is changed until
/// the flight ends within `most_miss` of the position. Steps are limited to half the speed.
/// Failures, also of the integration, are recorded.
TwoPointFlight fly_between(const SharedSystem& system, std::vector<double> guess,
                           const ClockTime& start_time, const Eigen::Vector3d& position,
                           double duration, double most_miss);

}  // namespace hamjet
