#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/maps/map_evaluator.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// How many standard normal numbers tell an encounter: six for each spacecraft.
inline constexpr std::size_t encounter_variables = 12;
using EncounterDeviation = Eigen::Matrix<double, 12, 1>;

/// Paths further from the sphere than this, in standard deviations, have a probability of 1e-19 or
/// less: they are left out.
inline constexpr double farthest_deviation = 9;

/// Relative position and velocity as a linear function of the twelve standard normal numbers.
struct LinearRelativeState {
  Eigen::Matrix<double, 6, 1> mean;
  Eigen::Matrix<double, 6, 12> by_deviation;
};

/// The relative motion of two spacecraft in a window of time, as a function of the deviations of
/// both at the epoch: at nodes in time by the polynomials of two jets, one about the mean of each
/// spacecraft, and between the nodes by the cubic through positions and velocities. Arcs between
/// nodes on which no path comes near a sphere are left out.
///
/// Immutable: threads may share one.
class RelativePaths {
 public:
  /// The first nodes are a sixteenth of a local period apart at most, so that no interval holds a
  /// revolution. Nodes are added between them until the cubics of the mean motion, and of the
  /// linear motion of deviations of four standard deviations, are right to `accuracy` (a length, or
  /// the accuracy of the flow itself where that is coarser). A cubic misses what it interpolates by
  ///
  ///   s^2 (1 - s)^2 h^4 / 24 |d^4 x / dt^4| ,
  ///
  /// s the part of the interval: of the misses at three parts that are not symmetric to each other,
  /// each relative to this factor, the largest is taken, at the factor's largest. `sphere` is the
  /// radius of the one that paths must come near to count; infinite for all.
  /// Throws as validate and integrate_gauss, and Error(too_large) for a window that would take too
  /// many nodes.
  RelativePaths(const EncounterProblem& problem, double accuracy, double sphere);

  const std::vector<double>& times() const noexcept { return times_; }
  /// The first nodes of the arcs that are not left out, each of which ends at the next node.
  const std::vector<std::size_t>& arcs() const noexcept { return arcs_; }
  /// Whether the window's begin is not left out: node 0.
  bool has_begin() const noexcept { return has_begin_; }
  /// The largest error of the cubics, as it was found; at most the accuracy.
  double interpolation_error() const noexcept { return interpolation_error_; }
  /// At a node, to first order.
  const LinearRelativeState& linear(std::size_t node) const { return linear_[node]; }
  /// At a time of an arc: the cubic between its nodes.
  LinearRelativeState linear_at(double time) const;

  /// Relative states at all nodes by the polynomials up to a degree, from 1 to the order. Points
  /// and states are structures of arrays: number i of point j of M is at i M + j, and component c
  /// (position, then velocity) at node k at (6 k + c) M + j.
  void evaluate(std::span<const double> points, int degree, std::span<double> states) const;

 private:
  struct Look;

  /// For each spacecraft and degree, from 1.
  std::array<std::vector<MapEvaluator>, 2> evaluators_;
  std::array<Eigen::Matrix<double, 6, 6>, 2> factors_;
  std::vector<double> times_;
  std::vector<LinearRelativeState> linear_;
  std::vector<std::size_t> arcs_;
  bool has_begin_ = false;
  double interpolation_error_ = 0;
};

}  // namespace hamjet
