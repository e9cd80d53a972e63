#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// A burn at full thrust between two switches, or an end of the transfer.
struct ThrustBurn {
  double start = 0;  ///< in canonical units, since the start
  double end = 0;
  double change_m_s = 0;  ///< integral of the acceleration
  /// Unit vectors of the thrust at both ends of the burn, along the axes of the scene's frame then.
  Eigen::Vector3d start_direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_direction = Eigen::Vector3d::Zero();

  double length() const { return end - start; }
};

/// The thrust that leads a deputy from its start to its end, in position and velocity, in one time
/// with the least integral of |u|, its acceleration |u| never above a limit. It is full where the
/// primer vector -lambda_v is longer than a threshold, along which it then is, and zero where it is
/// shorter. The threshold is 1; where the mass falls, and the limit grows, it is the costate of the
/// change spent so far, which is 1 at the start. Primer vectors are told in parts of it.
struct FuelOptimalTransfer {
  double time = 0;                ///< in canonical units
  std::vector<ThrustBurn> burns;  ///< in the order of time
  double change_m_s = 0;          ///< integral of |u|
  double energy_optimal_m_s = 0;  ///< the same integral of the energy-optimal thrust
  /// The least sum of impulses that was found for the same time and ends, and its bound to first
  /// order; absent where there is none.
  std::optional<double> impulses_m_s;
  std::optional<double> impulses_bound_m_s;
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  /// What the burns take; absent where the mass stays the same, and where there are none.
  std::optional<double> propellant_kg;
  /// Costates at the start, canonical, those of q and then those of p, in the unit in which the
  /// threshold is 1 there.
  std::vector<double> costates;
  // The conditions of the maximum principle, along the flight.
  double primer_at_switches = 0;  ///< the largest distance of its length from 1 at switches
  double primer_in_coasts = 0;    ///< the largest length while the thrust is zero
  double primer_in_burns = 0;     ///< the least while it is full; 0 without a burn
  /// Where forces do not depend on the time: the change of the Hamiltonian along the flight, in
  /// parts of its largest term.
  std::optional<double> hamiltonian_change;
  int continuation_steps = 0;  ///< from the energy-optimal thrust on
  int flights = 0;
  /// Where the thruster is too weak: the least acceleration, to a hundredth, with which a thrust
  /// was found.
  std::optional<double> least_acceleration_m_s2;
  std::string failure;  ///< if not empty, the reason why there is none

  bool is_found() const { return failure.empty(); }
};

/// Thrust and primer vector at a time on the way.
struct PrimerSample {
  double time = 0;  ///< in canonical units
  /// Acceleration along the axes of the scene's frame at that time.
  Eigen::Vector3d thrust_m_s2 = Eigen::Vector3d::Zero();
  double primer = 0;  ///< the length of the primer vector, in parts of the threshold
};

/// The results of `thrust = "fuel-optimal"`.
struct FuelOptimalTransfers {
  double acceleration_m_s2 = 0;                ///< the thruster's, at the start
  std::vector<FuelOptimalTransfer> transfers;  ///< one for each time, away from 0
  std::optional<std::size_t> least;            ///< the least change among those found
  std::vector<PrimerSample> profile;           ///< along the flight of the least, at equal times
  std::string failure;                         ///< if not empty, the reason why there is none
};

/// Why some of the times have no such thrust: of too weak thrusters and of too little propellant
/// the failure that lacks least, otherwise the first; empty if none failed.
std::string failures_text(const FuelOptimalTransfers& fuel);

}  // namespace hamjet
