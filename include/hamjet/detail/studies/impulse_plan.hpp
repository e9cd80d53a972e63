#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// A velocity change of a plan, along the axes of the scene's frame at its time.
struct Impulse {
  double time = 0;  ///< in canonical units
  Eigen::Vector3d change_m_s = Eigen::Vector3d::Zero();
};

/// The magnitude of the primer vector at a time: a small velocity change there saves or costs this
/// multiple of its own magnitude. (Lawden, Optimal Trajectories for Space Navigation, 1963.)
struct PrimerMagnitude {
  double time = 0;  ///< in canonical units
  double magnitude = 0;
};

/// The magnitude of the primer vector along a transfer of two impulses. Where it exceeds 1, a
/// further impulse makes the transfer cheaper. (Lion and Handelsman, AIAA Journal 6, 1968.)
struct PrimerHistory {
  std::vector<PrimerMagnitude> magnitudes;
  PrimerMagnitude largest;

  /// Whether the magnitude exceeds 1 by more than rounding, so that another impulse helps.
  bool calls_for_impulse() const { return largest.magnitude > 1 + 1e-6; }
};

/// The transfer from which a plan of impulses was developed.
enum class PlanOrigin {
  linear_theory,  ///< the linear theory about the chief
  two_impulses,   ///< the transfer with two impulses
  coasting,       ///< a transfer whose first impulse waits
  waypoints,
  revolutions,  ///< a transfer with another number of revolutions than the chief's
};

/// Impulses, of free number and times, whose sum of magnitudes is the least that was found for the
/// same start, end and arrival time.
struct ImpulsePlan {
  double duration = 0;  ///< in canonical units
  PlanOrigin origin = PlanOrigin::linear_theory;
  std::vector<Impulse> impulses;  ///< flown impulses, in the order of time
  /// A bound: to first order about this trajectory, no impulses in the same time do the same for
  /// less. Absent if flights did not confirm that the linear theory holds.
  std::optional<double> lower_bound_m_s;
  /// If the scene's largest impulse divides impulses into several, the time between possible
  /// impulses, in canonical units. The bound is then that of impulses at these times, none above
  /// the largest.
  std::optional<double> spacing;
  /// Primer vector that belongs to the bound: at most 1, except where an impulse has its largest
  /// allowed size.
  std::vector<PrimerMagnitude> primer;
  int flights = 0;  ///< number of flights that corrected the linear answers
  /// Distance between the wanted end and the place that the deputy reaches with this plan.
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  /// Rounding floor of the flown end in metres: the rounding at both ends of each leg, grown with
  /// the linear flow to the end. A miss below this means nothing.
  double flight_floor_m = 0;
  std::string failure;    ///< if not empty, the reason why the plan does not reach its end
  std::string forbidden;  ///< if not empty, the reason why the scene's limits forbid the plan

  double total_change_m_s() const;
};

/// The least cost for one of the listed times, in the linear theory about the chief.
struct LeastChange {
  double time = 0;                   ///< in canonical units
  std::optional<double> change_m_s;  ///< least cost, proved at the times of a coarse grid
  /// Cost of the same impulses after correction by flying; absent if not flown.
  std::optional<double> flown_m_s;
  std::string failure;  ///< if not empty, the reason why there is no least cost
  /// The solver's answer was not proved to be the least, so that the true least of all times may
  /// belong to this time.
  bool is_unproved = false;
};

/// The results of `impulses = "optimal"`.
struct OptimalImpulses {
  std::vector<LeastChange> by_time;  ///< for some of the listed times, including the last
  std::optional<ImpulsePlan> plan;   ///< the flown plan of least cost
  std::string failure;               ///< if not empty, the reason why there is no plan

  bool is_found() const { return plan && plan->failure.empty() && plan->forbidden.empty(); }
  /// Whether the solver succeeded at every time.
  bool is_proved() const;
};

}  // namespace hamjet
