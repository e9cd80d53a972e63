#pragma once

#include <optional>
#include <vector>

#include "companion_flow.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// A deputy in flight: its deviation from the orbit of a CompanionFlow at a time, before any
/// impulse at that time.
struct Underway {
  double time = 0;
  std::vector<double> deviation;  ///< canonical (dq, dp)
};

/// The legs of a deputy's way from the scene's start to its end, each flown from place to place.
/// All arguments of the constructor must outlive it.
class Route {
 public:
  Route(const Scene& scene, const ComputedProblem& problem, const CompanionFlow& flow);

  /// The deputy at the start, and after a time of flight without an impulse. Throws as exact_flow.
  Underway start() const;
  Underway coast_to(double time) const;
  /// The deputy after a time without an impulse, in the linear flow.
  Underway linear_coast_to(double time) const;

  /// The sum of the magnitudes of both impulses of a leg to the scene's end, in the linear flow.
  /// Throws Error(numerical) if no velocity leads there.
  double linear_change_m_s(const Underway& from, double time) const;

  /// Canonical deviations from that orbit at a time: of a place along the axes of the scene's
  /// frame, and of the scene's end.
  std::vector<double> place(double time, const Eigen::Vector3d& position_m) const;
  std::vector<double> end(double time) const;

  /// Adds the leg from the deputy's present state to the place with a given deviation from the
  /// orbit at `time`, with the impulse at its start. The answer of the linear flow is corrected by
  /// Newton's method until the miss is at most the scene's `refined_miss_m`. Throws
  /// Error(numerical) if this fails.
  Underway fly_to(const Underway& from, double time, const std::vector<double>& wanted,
                  WaypointPlan& plan);
  /// Does what fly_to does, but starts from a guess of the deputy's state at the start of the leg,
  /// after the impulse.
  Underway fly_from_guess(const Underway& from, double time, const std::vector<double>& wanted,
                          std::vector<double> guess, WaypointPlan& plan);
  /// Adds the impulse at the end, and results that need the whole plan; primer vectors of the legs
  /// if `has_primer`.
  void finish(const Underway& there, WaypointPlan& plan, bool has_primer = true) const;
  /// The deviation from the orbit at the start of the last leg, after the impulse.
  const std::vector<double>& begun() const { return ways_.back(); }
  /// Removes the legs after the first `count`.
  void keep_legs(std::size_t count) { ways_.resize(count); }

 private:
  ChiefFrame frame(double time) const;
  Eigen::Vector3d linear_momentum(const Underway& from, double time,
                                  const Eigen::Matrix<double, 6, 6>& between,
                                  const Eigen::Vector3d& place) const;
  Eigen::Matrix<double, 6, 6> flow_between(double first, double last) const;
  void add_impulse(WaypointPlan& plan, double time, const std::vector<double>& after,
                   const std::vector<double>& before) const;
  Eigen::Vector3d direction(const Impulse& impulse) const;
  std::optional<PrimerMagnitude> primer_of_leg(const WaypointPlan& plan, std::size_t k) const;
  void judge_limits(WaypointPlan& plan) const;

  const Scene& scene_;
  const ComputedProblem& problem_;
  const CompanionFlow& flow_;
  MetricUnits units_;
  double momentum_unit_;
  /// Deviations at the starts of the legs, after the impulses.
  std::vector<std::vector<double>> ways_;
};

}  // namespace hamjet
