#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/charts/straight_deviations.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// One of two spacecraft at the epoch, in the units of the system.
struct UncertainSpacecraft {
  std::vector<double> state;  ///< the mean, six numbers (position, velocity)
  /// The factor L of the covariance L L^T: the linear deviation from the mean is L xi, where xi are
  /// six independent standard normal numbers.
  Eigen::Matrix<double, 6, 6> factor = Eigen::Matrix<double, 6, 6>::Zero();
  /// For a state that is Gaussian in the coordinates of a chart: the deviations to which linear
  /// ones belong, about `state`. Without, positions and velocities are Gaussian.
  std::optional<StraightDeviations> straight;
  /// The equations of motion of this spacecraft, where its coefficients are others than those of
  /// the encounter's system.
  SharedSystem own_system;

  /// The state that belongs to the linear deviation L xi. Its numbers are not finite if the chart's
  /// coordinates belong to no state.
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
  int order = 3;         ///< order of the polynomials in the linear deviations at the epoch
  GaussSettings settings = {};
  /// If given, a length: a distribution of which the polynomials are wrong by more within three
  /// standard deviations is taken in parts, each with polynomials about its own mean.
  std::optional<double> tolerance = {};
  std::size_t most_parts = 256;  ///< of one spacecraft, where the tolerance alone asks for them

  const SharedSystem& system_of(std::size_t craft) const {
    const SharedSystem& own = spacecraft[craft].own_system;
    return own ? own : system;
  }
  bool has_one_system() const { return !spacecraft[0].own_system && !spacecraft[1].own_system; }
};

/// Throws Error(usage) unless the sizes and systems fit, the window does not end before it begins,
/// and the radius is positive, and Error(numerical) for numbers that are not finite.
void validate(const EncounterProblem& problem);

}  // namespace hamjet
