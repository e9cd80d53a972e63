#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/impulse_plan.hpp"

namespace hamjet {

/// The part of a plan between two successive impulses.
struct WaypointLeg {
  double start = 0;  ///< in canonical time
  double end = 0;
  int flights = 0;    ///< number of flights that the search took
  double miss_m = 0;  ///< miss of the place at its end, flown with the full equations of motion
  /// The point of the leg at which the primer vector, which is along the impulses at the ends, is
  /// largest. Above 1, a further impulse there makes the plan cheaper while the places at both ends
  /// stay. Absent if an impulse is zero, or if positions cannot be commanded.
  std::optional<PrimerMagnitude> primer;
};

/// A transfer through the scene's waypoints, with an impulse at the start, at each of them and at
/// the end.
struct WaypointPlan {
  double duration = 0;            ///< in canonical units
  std::vector<Impulse> impulses;  ///< one impulse more than there are legs
  std::vector<WaypointLeg> legs;
  std::string forbidden;  ///< if not empty, the reason why the scene's limits forbid the plan

  double total_change_m_s() const;
};

/// The results of `[[transfer.waypoint]]`.
struct WaypointTransfers {
  std::vector<WaypointPlan> plans;       ///< for the transfer times after the last waypoint
  std::optional<std::size_t> best_plan;  ///< the cheapest plan among those that are allowed
  std::string failure;                   ///< if not empty, the reason why there is no plan
};

/// The result of `longest_coast_s`: a transfer with two impulses of which the first waits while the
/// deputy drifts.
struct CoastingTransfer {
  /// The cheapest flown plan; its only leg begins after the wait.
  std::optional<WaypointPlan> plan;
  std::string failure;  ///< if not empty, the reason why there is no plan
};

/// A transfer with two impulses that makes another number of revolutions than its chief, or the
/// same number on the other of two orbits. The polynomials about the chief do not reach it.
struct RevolutionTransfer {
  double time = 0;     ///< in canonical units
  int difference = 0;  ///< number of whole revolutions more than the chief makes
  /// Whether it is the one of the longer period, of the two orbits with this number.
  bool is_higher = false;
  WaypointPlan plan;    ///< plan with one leg
  std::string failure;  ///< if not empty, the reason why the transfer was not found
};

/// The results of `revolutions`.
struct OtherRevolutions {
  std::vector<RevolutionTransfer> transfers;  ///< for each transfer time and each existing orbit
  std::optional<std::size_t> best;  ///< the cheapest transfer among those that are allowed
  std::string failure;              ///< if not empty, the reason why there is none
};

}  // namespace hamjet
