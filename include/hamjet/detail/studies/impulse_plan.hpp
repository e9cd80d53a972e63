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

/// As many impulses, at such times, that their sum of magnitudes is the least of all with the same
/// start, end and arrival.
struct ImpulsePlan {
  double duration = 0;            ///< canonical
  std::vector<Impulse> impulses;  ///< flown; in the order of time
  double linear_change_m_s = 0;   ///< the sum of the magnitudes in the linear theory
  /// No impulses at any time do what these do for less, in the linear theory, in which these lead a
  /// little off the end.
  double lower_bound_m_s = 0;
  /// Where the scene's largest impulse divides others: the time between those at which impulses
  /// may be, canonical. The bound is then that of such impulses, none above the largest.
  std::optional<double> spacing;
  /// Of that bound: at most 1, but where an impulse is as large as it may be.
  std::vector<PrimerMagnitude> primer;
  int flights = 0;  ///< that corrected the linear answer
  /// Where the deputy that flies the plan comes to, beside the wanted end.
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;    ///< not empty: the plan was not brought to its end, and why
  std::string forbidden;  ///< not empty: the scene's limits do not allow it, and why

  double total_change_m_s() const;
};

/// The least cost for one of the listed times, in the linear theory.
struct LeastChange {
  double time = 0;  ///< canonical
  double change_m_s = 0;
};

/// What `impulses = "optimal"` asks for.
struct OptimalImpulses {
  std::vector<LeastChange> by_time;  ///< for some of the listed times, the last among them
  /// Of the time of the least cost, the shortest of those that cost no more than a thousandth more.
  std::optional<ImpulsePlan> plan;
  std::string failure;  ///< not empty: there is no plan, and why

  bool is_found() const { return plan && plan->failure.empty() && plan->forbidden.empty(); }
};

}  // namespace hamjet
