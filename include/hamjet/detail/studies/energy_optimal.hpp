#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// The energy-optimal thrust by the polynomials of one order, and the misses of the deputy that
/// flies it with the full equations of motion.
struct EnergyOptimalAnswer {
  int order = 0;
  /// Deviations of the costates at the start, those of q and then those of p, canonical.
  std::vector<double> costates;
  double energy_m2_s3 = 0;  ///< the least integral of |u|^2 / 2 by the generating function
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;  ///< if not empty, the reason why this order has no answer
};

/// The thrust that leads a deputy from its start to its end, in position and velocity, in one time
/// with the least integral of |u|^2 / 2, u being its acceleration.
struct EnergyOptimalTransfer {
  double time = 0;                           ///< in canonical units
  double condition = 0;                      ///< of the linear part that is inverted, dx/dlambda0
  std::vector<EnergyOptimalAnswer> answers;  ///< of the orders 1..N
  /// The answer of order N, corrected by flying until both misses are as small as asked for.
  std::optional<EnergyOptimalAnswer> refined;
  int refinement_flights = 0;
  // Of the corrected answer, along its flight, in SI units:
  double energy_m2_s3 = 0;      ///< integral of |u|^2 / 2
  double change_m_s = 0;        ///< integral of |u|
  double largest_m_s2 = 0;      ///< largest |u|
  bool exceeds_thrust = false;  ///< this is more than the scene's `largest_thrust_m_s2`
  /// Its acceleration at the start and at the end, along the axes of the scene's frame.
  Eigen::Vector3d start_thrust_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_thrust_m_s2 = Eigen::Vector3d::Zero();
  std::string failure;  ///< if not empty, the reason why there is none

  bool is_found() const { return failure.empty(); }
};

/// The thrust at a time on the way.
struct ThrustSample {
  double time = 0;  ///< in canonical units
  /// Acceleration along the axes of the scene's frame at that time.
  Eigen::Vector3d thrust_m_s2 = Eigen::Vector3d::Zero();
};

/// The results of `thrust = "energy-optimal"`.
struct EnergyOptimalTransfers {
  int order = 0;                                 ///< N of the jets in states and costates
  std::vector<EnergyOptimalTransfer> transfers;  ///< one for each time, away from 0
  std::optional<std::size_t> least;   ///< the least change among those found that the scene allows
  std::vector<ThrustSample> profile;  ///< along the flight of the least, at equal times
  std::string failure;                ///< if not empty, the reason why there is none
};

}  // namespace hamjet
