#pragma once

#include <array>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// One of two spacecraft at the epoch, in the units of the system.
struct UncertainSpacecraft {
  std::vector<double> state;  ///< the mean, six numbers (position, velocity)
  /// L of the covariance L L^T: the deviation from the mean is L xi, xi six independent standard
  /// normal numbers.
  Eigen::Matrix<double, 6, 6> factor = Eigen::Matrix<double, 6, 6>::Zero();

  /// The state with the deviation of these numbers xi.
  std::array<double, 6> deviated(const Eigen::Matrix<double, 6, 1>& xi) const;
};

/// Two spacecraft whose states at the epoch are uncertain and independent, and a window of time in
/// which they may meet, all in the units of the system. The relative position is the second's less
/// the first's.
struct EncounterProblem {
  SharedSystem system;
  std::array<UncertainSpacecraft, 2> spacecraft;
  double from = 0;    ///< the window, in time after the epoch; before it where negative
  double to = 0;      ///< not before `from`
  double radius = 0;  ///< the sum of the radii of both bodies: nearer than this is a collision
  int order = 3;      ///< of the polynomials in the deviations at the epoch
  GaussSettings settings;
};

/// Throws Error(usage) unless the sizes fit, the window is one and the radius is positive, and
/// Error(numerical) for numbers that are not finite.
void validate(const EncounterProblem& problem);

}  // namespace hamjet
