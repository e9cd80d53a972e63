#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Angular frequency that converts a position deviation to the momentum deviation of the same size.
/// It is the mean motion of an elliptic orbit, otherwise that of a circular orbit at the initial
/// radius, and sqrt(k m) for the oscillator (momentum per length).
double momentum_per_length(const Scene& scene);

/// The length beside which deviations are small, in canonical units: an orbit's distance from the
/// centre at the start; of other nominals the largest of |q| and |p| there, 1 at the origin.
double size_of_nominal(const Scene& scene);

/// Deviations of the scene's separation, at which jets are compared: along each axis of position,
/// and random ones from a fixed seed, every second of which has a random momentum of the same size
/// (see momentum_per_length).
class FormationPoints {
 public:
  FormationPoints(const Scene& scene, const ComputedProblem& problem);

  std::size_t size() const noexcept { return points_.size(); }

  /// Largest distance, over all points, between the final positions that two jets give, in metres.
  double position_error_m(const FlowJet<Extended>& jet, const FlowJet<Extended>& reference) const;

 private:
  /// The points in canonical units, with an entry for each variable.
  std::vector<std::vector<double>> points_;
  std::size_t positions_ = 0;  ///< number of components that are positions
  double metres_ = 0;          ///< metres per canonical unit of length
};

}  // namespace hamjet
