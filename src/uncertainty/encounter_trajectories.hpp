#pragma once

#include <array>
#include <vector>

#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/uncertainty/encounter.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// The jets of both spacecraft of an encounter at the times of its window, after the epoch. Of the
/// means alone, those of a problem of order 0 tell as much and are quicker.
///
/// Immutable: threads may share one.
class EncounterTrajectories {
 public:
  /// Throws as integrate_gauss.
  explicit EncounterTrajectories(const EncounterProblem& problem);

  double from() const { return from_; }
  double to() const { return to_; }
  FlowJet<double> jet(std::size_t craft, double time) const;
  /// To first order.
  LinearRelativeState linear(double time) const;
  LinearRelativeState linear(const std::array<FlowJet<double>, 2>& jets) const;

  /// Of the means: distance, rho.v, and the derivative of that by time.
  double distance(double time) const;
  double approach_rate(double time) const;
  double approach_rate_slope(double time) const;
  /// The period of the small circle through a spacecraft's start, sqrt(r^3), in units of the
  /// system: a revolution for a central body of unit gravity.
  double period(std::size_t craft) const;
  /// The same of the circle through where it is at a time.
  double local_period(std::size_t craft, double time) const;
  double distance_from_centre(std::size_t craft, double time) const;
  /// A bound on what the second order adds to the relative position for deviations of so many
  /// standard deviations, from jets of order 2 at least: the norms of its coefficients.
  double second_order(const std::array<FlowJet<double>, 2>& jets, double deviations) const;
  /// The window in steps of a part of the shorter of the two local periods, those of the small
  /// circles through where the spacecraft are: equal steps would see too little of a perigee, where
  /// an eccentric orbit turns many times as fast as on average. There are at least `fewest` steps;
  /// throws Error(too_large) where more than 200000 are needed.
  std::vector<double> times_of_looks(double per_period = 64, double fewest = 64) const;

 private:
  Eigen::Matrix<double, 6, 1> relative_mean(double time) const;

  SharedSystem system_;
  std::array<std::vector<double>, 2> starts_;
  std::array<Eigen::Matrix<double, 6, 6>, 2> factors_;
  double from_;
  double to_;
  std::vector<JetTrajectory<double>> trajectories_;  ///< two, of the window
};

}  // namespace hamjet
