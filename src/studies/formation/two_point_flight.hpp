#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The position and the momentum of a state (q, p).
inline Eigen::Vector3d position_of(const std::vector<double>& z) { return {z[0], z[1], z[2]}; }
inline Eigen::Vector3d momentum_of(const std::vector<double>& z) { return {z[3], z[4], z[5]}; }

/// A flight from one position to another in a given time. Canonical.
struct TwoPointFlight {
  std::vector<double> start;  ///< state (q, p), the impulse there made
  std::vector<double> end;    ///< state to which it comes
  double miss = 0;            ///< distance of that from the wanted position
  int flights = 0;
  std::string failure;  ///< not empty: the wanted position was not reached, and why

  bool is_found() const { return failure.empty(); }
};

/// Newton's method on flown trajectories, with the linear part of the flow about each: the velocity
/// at the start of `guess` is changed until the flight comes within `most_miss` of the position.
/// Steps are shortened to half the speed. Failures are recorded, those of the integration too.
TwoPointFlight fly_between(const SharedSystem& system, std::vector<double> guess,
                           const Eigen::Vector3d& position, double duration, double most_miss);

}  // namespace hamjet
