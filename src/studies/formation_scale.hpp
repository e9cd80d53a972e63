#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Angular frequency that makes a position deviation into the momentum deviation of the same size:
/// the mean motion of an elliptic orbit, that of a circular orbit at the initial radius otherwise,
/// sqrt(k m) for the oscillator (momentum per length).
double momentum_per_length(const Scene& scene);

/// Deviations of the scene's separation, at which jets are compared: along each axis of position,
/// and random ones of a fixed seed, every second one with a random momentum of the same size (see
/// momentum_per_length).
class FormationPoints {
 public:
  FormationPoints(const Scene& scene, const ComputedProblem& problem);

  std::size_t size() const noexcept { return points_.size(); }

  /// Largest distance, over all points, between the final positions that two jets give; metres.
  double position_error_m(const FlowJet<Extended>& jet, const FlowJet<Extended>& reference) const;

 private:
  std::vector<std::vector<double>> points_;  ///< canonical, an entry for each variable
  std::size_t positions_ = 0;                ///< components that are positions
  double metres_ = 0;                        ///< metres in one canonical unit of length
};

}  // namespace hamjet
