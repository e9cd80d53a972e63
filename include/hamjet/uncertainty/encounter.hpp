#pragma once

#include <array>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// One of two spacecraft at the epoch, in the units of the system.
struct UncertainSpacecraft {
  std::vector<double> state;  ///< the mean, six numbers (position, velocity)
  /// The factor L of the covariance L L^T: the deviation from the mean is L xi, where xi are six
  /// independent standard normal numbers.
  Eigen::Matrix<double, 6, 6> factor = Eigen::Matrix<double, 6, 6>::Zero();

  /// The state that deviates from the mean by L xi.
  std::array<double, 6> deviated(const Eigen::Matrix<double, 6, 1>& xi) const;
};

/// Two spacecraft whose states at the epoch are uncertain and independent, and a window of time in
/// which they may meet, all in the units of the system. The relative position is that of the second
/// spacecraft minus that of the first.
struct EncounterProblem {
  SharedSystem system;
  std::array<UncertainSpacecraft, 2> spacecraft;
  ClockTime start_time;  ///< the epoch of both states, on the system's clock
  double from = 0;       ///< start of the window, after the epoch; before the epoch where negative
  double to = 0;         ///< end of the window; not before `from`
  double radius = 0;     ///< the sum of the radii of both bodies: a smaller distance is a collision
  int order = 3;         ///< order of the polynomials in the deviations at the epoch
  GaussSettings settings = {};
};

/// Throws Error(usage) unless the sizes fit, the window does not end before it begins, and the
/// radius is positive, and Error(numerical) for numbers that are not finite.
void validate(const EncounterProblem& problem);

}  // namespace hamjet
