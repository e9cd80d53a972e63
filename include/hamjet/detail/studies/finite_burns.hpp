#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// A burn in place of an impulse. Its time is the mean time of its change: its middle, or later as
/// the mass falls.
struct FiniteBurn {
  double time = 0;  ///< the time of the impulse, in canonical units
  double start = 0;
  double end = 0;
  /// Unit vector along the axes of the thruster's attitude.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double change_m_s = 0;   ///< integral of the acceleration's magnitude
  double impulse_m_s = 0;  ///< magnitude of the impulse
  /// Propellant that the burn takes, and mass behind it; absent if the mass does not fall.
  std::optional<double> propellant_kg;
  std::optional<double> mass_after_kg;

  /// By how much the burn's change is larger than the impulse.
  double loss_m_s() const { return change_m_s - impulse_m_s; }
};

/// Burns in place of the impulses of one transfer. Impulses at its ends become burns that begin
/// before its start and end after its end; the deputy's ends are those of its coasting orbits.
struct BurnPlan {
  bool is_optimal = false;  ///< for the plan of optimal impulses, otherwise for the two
  double duration = 0;      ///< between the ends, in canonical units
  double impulses_m_s = 0;  ///< sum of the impulses' magnitudes
  /// In the order of time; empty if none were found.
  std::vector<FiniteBurn> burns;
  int flights = 0;
  /// Misses of the deputy that flies the burns with the full equations of motion.
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;  ///< if not empty, the reason why these burns cannot replace the impulses
  /// If the thruster is too weak, the least acceleration of the full spacecraft, to a hundredth,
  /// with which burns were found; sought for the cheapest impulses alone.
  std::optional<double> least_acceleration_m_s2;

  bool is_found() const { return failure.empty(); }
  double change_m_s() const;
  double loss_m_s() const { return change_m_s() - impulses_m_s; }  ///< of all burns
  std::optional<double> propellant_kg() const;                     ///< the propellant of all burns
};

/// The burns of table `[thruster]`.
struct FiniteBurns {
  /// The plans for two impulses by transfer time, away from 0, and then those for the optimal
  /// impulses if the scene asks for them.
  std::vector<BurnPlan> plans;
  std::optional<std::size_t> least;  ///< index of the least change of those that were found
  std::string failure;               ///< if not empty, the reason why there is none

  /// The plan whose impulses have the least sum; null without any.
  const BurnPlan* cheapest_impulses() const;
};

}  // namespace hamjet
