#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// A velocity change of a plan, along the axes of the scene's frame at its time.
struct Impulse {
  double time = 0;  ///< canonical
  Eigen::Vector3d change_m_s = Eigen::Vector3d::Zero();
};

/// The magnitude of the primer vector at a time: the cost that a small velocity change there saves
/// or takes, of its own magnitude. (Lawden, Optimal Trajectories for Space Navigation, 1963.)
struct PrimerMagnitude {
  double time = 0;  ///< canonical
  double magnitude = 0;
};

/// The magnitude of the primer vector along a transfer of two impulses. Where it exceeds 1, a
/// further impulse makes the transfer cheaper. (Lion and Handelsman, AIAA Journal 6, 1968.)
struct PrimerHistory {
  std::vector<PrimerMagnitude> magnitudes;
  PrimerMagnitude largest;

  /// Whether more than the rounding of the flow tells that another impulse helps.
  bool calls_for_impulse() const { return largest.magnitude > 1 + 1e-6; }
};

/// From which way a plan of impulses began.
enum class PlanOrigin {
  linear_theory,  ///< about the chief
  two_impulses,   ///< of the transfer
  coasting,       ///< a transfer whose first impulse waits
  waypoints,
  revolutions,  ///< other ones than the chief's
};

/// As many impulses, at such times, that their sum of magnitudes is the least that was found with
/// the same start, end and arrival.
struct ImpulsePlan {
  double duration = 0;  ///< canonical
  PlanOrigin origin = PlanOrigin::linear_theory;
  std::vector<Impulse> impulses;  ///< flown; in the order of time
  /// No impulses in the same time do what these do for less, to first order about the way of these;
  /// absent where flights did not confirm that the linear theory holds so far.
  std::optional<double> lower_bound_m_s;
  /// Where the scene's largest impulse divides others: the time between those at which impulses
  /// may be, canonical. The bound is then that of such impulses, none above the largest.
  std::optional<double> spacing;
  /// Of that bound: at most 1, but where an impulse is as large as it may be.
  std::vector<PrimerMagnitude> primer;
  int flights = 0;  ///< that corrected the linear answers
  /// Where the deputy that flies the plan comes to, beside the wanted end.
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;    ///< not empty: the plan was not brought to its end, and why
  std::string forbidden;  ///< not empty: the scene's limits do not allow it, and why

  double total_change_m_s() const;
};

/// The least cost for one of the listed times, in the linear theory about the chief.
struct LeastChange {
  double time = 0;                   ///< canonical
  std::optional<double> change_m_s;  ///< proved to be the least at the times of a coarse grid
  std::optional<double> flown_m_s;   ///< the same impulses, corrected by flying; absent: not flown
  std::string failure;               ///< not empty: there is none, and why
  /// The solver's answer did not prove to be one: the least of all times may be that of this one.
  bool is_unproved = false;
};

/// What `impulses = "optimal"` asks for.
struct OptimalImpulses {
  std::vector<LeastChange> by_time;  ///< for some of the listed times, the last among them
  std::optional<ImpulsePlan> plan;   ///< the least that was flown
  std::string failure;               ///< not empty: there is no plan, and why

  bool is_found() const { return plan && plan->failure.empty() && plan->forbidden.empty(); }
  /// Whether no time was left out because the solver failed.
  bool is_proved() const;
};

}  // namespace hamjet
