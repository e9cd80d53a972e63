#pragma once

#include <string>
#include <vector>

#include "burn_flight.hpp"

namespace hamjet {

/// Burns in place of the impulses of one transfer, by Newton's method on flown misses. All
/// arguments of the constructor must outlive it.
class BurnSearch {
 public:
  BurnSearch(const Scene& scene, const ComputedProblem& problem, const SharedSystem& burning,
             const std::vector<Impulse>& impulses, double duration);

  /// The burns of the scene's thruster, or why there are none; without its duration and impulses.
  BurnPlan plan();
  /// Flies the burns of a plan that was found, and looks as BurnFlight::flown.
  void look_along(const BurnPlan& plan, double pace, const BurnFlight::Look& look) const;
  /// Whether this plan has none because the thruster takes too long.
  bool is_too_weak() const { return is_too_weak_; }
  /// The least acceleration in m/s^2, to a hundredth and above the thruster's, with which burns
  /// were found; no value if they were found with none.
  std::optional<double> least_acceleration_m_s2();

 private:
  using Changes = BurnFlight::Changes;
  /// What Newton's method came to.
  struct Attempt {
    Changes changes;
    BurnFlight::Vector6 missing = BurnFlight::Vector6::Zero();
    std::string failure;
  };

  Attempt attempt(const CanonicalThruster& thruster, Changes changes);
  Changes step(const CanonicalThruster& thruster, const Changes& changes,
               const BurnFlight::Vector6& missing);
  CanonicalThruster stronger(double share) const;
  std::string misplaced(const CanonicalThruster& thruster, const Changes& changes) const;
  std::string forbidden(const BurnPlan& plan) const;
  double seconds(double time) const { return time * scene_.units.time_s; }

  const Scene& scene_;
  const std::vector<Impulse>& impulses_;
  double duration_;
  BurnFlight flight_;
  CanonicalThruster thruster_;
  Changes from_;  ///< the impulses
  int flights_ = 0;
  bool is_too_weak_ = false;
};

}  // namespace hamjet
