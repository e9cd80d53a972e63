#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/impulse_plan.hpp"

namespace hamjet {

/// The way from one of a plan's impulses to the next.
struct WaypointLeg {
  double start = 0;  ///< canonical time
  double end = 0;
  int flights = 0;    ///< that it took to find it
  double miss_m = 0;  ///< of the place at its end, flown with the full equations of motion
  /// Where the primer vector of the leg, along the impulses at its ends, is the largest: above 1 a
  /// further impulse there makes the plan cheaper, the places at both ends kept. Absent where an
  /// impulse is zero, or positions cannot be commanded.
  std::optional<PrimerMagnitude> primer;
};

/// A transfer through the scene's waypoints, with an impulse at the start, at each of them and at
/// the end.
struct WaypointPlan {
  double duration = 0;            ///< canonical
  std::vector<Impulse> impulses;  ///< one more than there are legs
  std::vector<WaypointLeg> legs;
  std::string forbidden;  ///< not empty: the scene's limits do not allow it, and why

  double total_change_m_s() const;
};

/// What `[[transfer.waypoint]]` asks for.
struct WaypointTransfers {
  std::vector<WaypointPlan> plans;       ///< for the transfer times behind the last waypoint
  std::optional<std::size_t> best_plan;  ///< the least of those that are allowed
  std::string failure;                   ///< not empty: there is none, and why
};

/// What `longest_coast_s` asks for: two impulses of which the first waits while the deputy drifts.
struct CoastingTransfer {
  std::optional<WaypointPlan>
      plan;             ///< the least that was flown; its only leg begins after the wait
  std::string failure;  ///< not empty: there is none, and why
};

/// A transfer of two impulses that makes another number of revolutions than its chief, or as many
/// on the other of two orbits, so that the polynomials about the chief do not reach it.
struct RevolutionTransfer {
  double time = 0;         ///< canonical
  int difference = 0;      ///< of the whole revolutions from those of the chief's own way
  bool is_higher = false;  ///< of both orbits that make them, that of the longer period
  WaypointPlan plan;       ///< of one leg
  std::string failure;     ///< not empty: it was not found, and why
};

/// What `revolutions` asks for.
struct OtherRevolutions {
  std::vector<RevolutionTransfer> transfers;  ///< for each transfer time and each orbit there is
  std::optional<std::size_t> best;            ///< the least of those that are allowed
  std::string failure;                        ///< not empty: there is none, and why
};

}  // namespace hamjet
