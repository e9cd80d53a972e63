#pragma once

#include <array>
#include <memory>
#include <vector>

#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/uncertainty/encounter.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// The jets of one spacecraft in the window of an encounter, in its linear deviations at the epoch.
/// They are immutable, and encounters may share them.
using WindowJets = std::shared_ptr<const JetTrajectory<double>>;
/// Throws as integrate_gauss.
WindowJets window_jets(const EncounterProblem& problem, std::size_t craft);

/// The jets of both spacecraft of an encounter, in their linear deviations, at the times of its
/// window, after the epoch. If only the means are needed, a problem of order 0 gives the same and
/// is faster.
///
/// The object is immutable: threads may share one.
class EncounterTrajectories {
 public:
  /// Throws as integrate_gauss.
  explicit EncounterTrajectories(const EncounterProblem& problem);
  /// Makes the trajectories from jets that exist already.
  EncounterTrajectories(const EncounterProblem& problem, std::array<WindowJets, 2> jets);

  double from() const { return from_; }
  double to() const { return to_; }
  FlowJet<double> jet(std::size_t craft, double time) const;
  /// The relative state to first order.
  LinearRelativeState linear(double time) const;
  LinearRelativeState linear(const std::array<FlowJet<double>, 2>& jets) const;

  /// The distance of the means, their rho.v, and the derivative of rho.v by time.
  double distance(double time) const;
  double approach_rate(double time) const;
  double approach_rate_slope(double time) const;
  /// The period of the small circle through a spacecraft's start, sqrt(r^3), in units of the
  /// system: a revolution for a central body of unit gravity.
  double period(std::size_t craft) const;
  /// The period of the small circle through the spacecraft's position at a time.
  double local_period(std::size_t craft, double time) const;
  /// A bound, by the norms of coefficients, of what the second order adds to the relative position,
  /// for deviations of this many standard deviations. The jets must have order 2 at least.
  double second_order(const std::array<FlowJet<double>, 2>& jets, double deviations) const;
  /// The window in steps that are a fraction of the shorter of the two local periods, those of the
  /// circles through the momentary positions. Equal steps would see too little of a perigee, where
  /// an eccentric orbit turns many times as fast as on average. There are at least `fewest` steps;
  /// throws Error(too_large) where more than 200000 are needed.
  std::vector<double> times_of_looks(double per_period = 64, double fewest = 64) const;

 private:
  Eigen::Matrix<double, 6, 1> relative_mean(double time) const;

  std::array<std::vector<double>, 2> starts_;
  std::array<Eigen::Matrix<double, 6, 6>, 2> factors_;
  double from_;
  double to_;
  std::array<WindowJets, 2> jets_;
};

}  // namespace hamjet
