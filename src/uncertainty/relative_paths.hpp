#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/maps/map_evaluator.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

class EncounterTrajectories;

/// The number of standard normal numbers that describe an encounter: six for each spacecraft.
inline constexpr std::size_t encounter_variables = 12;
using EncounterDeviation = Eigen::Matrix<double, 12, 1>;

/// Paths further from the sphere than this, in standard deviations, have a probability of 1e-19 or
/// less and are left out.
inline constexpr double farthest_deviation = 9;

/// The order of the jets by which nodes are chosen, where that of the problem is not lower.
inline constexpr int order_of_looks = 2;

/// Relative position and velocity as a linear function of the twelve standard normal numbers.
struct LinearRelativeState {
  Eigen::Matrix<double, 6, 1> mean;
  Eigen::Matrix<double, 6, 12> by_deviation;
};
/// Two unit vectors across the mean's relative velocity and each other, as rows.
Eigen::Matrix<double, 2, 3> plane_across(const LinearRelativeState& state);

/// The relative motion of two spacecraft in a window of time, as a function of the deviations of
/// both at the epoch: at nodes in time by the polynomials of two jets, one about the mean of each
/// spacecraft, and between the nodes by the cubic through positions and velocities. Arcs between
/// nodes on which no path comes near a sphere are left out.
///
/// The object is immutable: threads may share one.
class RelativePaths {
 public:
  /// The first nodes are a sixteenth of a local period apart at most, so that no interval holds a
  /// revolution. Nodes are added between them until the cubics of the mean motion, and of the
  /// linear motion of deviations of four standard deviations, are accurate to `accuracy` (a
  /// length), or to the accuracy of the flow itself where that is coarser. The error of a cubic is
  ///
  ///   s^2 (1 - s)^2 h^4 / 24 |d^4 x / dt^4| ,
  ///
  /// with s the fraction of the interval. It is measured at three fractions that are not symmetric
  /// to each other; each measured error gives the fourth derivative, and the largest of these gives
  /// the largest error. Only paths that come near the sphere of radius `sphere` count; if it is
  /// infinite, all do. Throws as validate and integrate_gauss, and Error(too_large) for a window
  /// that would take too many nodes.
  RelativePaths(const EncounterProblem& problem, double accuracy, double sphere);
  /// Makes the paths from jets that exist already, of the problem's order and of order_of_looks.
  RelativePaths(const EncounterProblem& problem, double accuracy, double sphere,
                const EncounterTrajectories& trajectories, const EncounterTrajectories& low);

  const std::vector<double>& times() const noexcept { return times_; }
  /// The first node of each arc that is not left out; an arc ends at the next node.
  const std::vector<std::size_t>& arcs() const noexcept { return arcs_; }
  /// Whether the beginning of the window, node 0, is not left out.
  bool has_begin() const noexcept { return has_begin_; }
  /// The largest error of the cubics that was found; at most the accuracy.
  double interpolation_error() const noexcept { return interpolation_error_; }
  /// The relative state at a node, to first order.
  const LinearRelativeState& linear(std::size_t node) const { return linear_[node]; }
  /// The relative state at a time of an arc, by the cubic between its nodes.
  LinearRelativeState linear_at(double time) const;

  /// Relative states at all nodes by the polynomials up to a degree, from 1 to the order. Points
  /// and states are structures of arrays: number i of point j of M is at i M + j, and component c
  /// (position, then velocity) at node k at (6 k + c) M + j.
  void evaluate(std::span<const double> points, int degree, std::span<double> states) const;

 private:
  struct Look;

  void lay_nodes(const EncounterProblem& problem, double accuracy, double sphere,
                 const EncounterTrajectories& trajectories, const EncounterTrajectories& low);

  /// An evaluator for each spacecraft and each degree, from 1 on.
  std::array<std::vector<MapEvaluator>, 2> evaluators_;
  std::array<Eigen::Matrix<double, 6, 6>, 2> factors_;
  std::vector<double> times_;
  std::vector<LinearRelativeState> linear_;
  std::vector<std::size_t> arcs_;
  bool has_begin_ = false;
  double interpolation_error_ = 0;
};

}  // namespace hamjet
