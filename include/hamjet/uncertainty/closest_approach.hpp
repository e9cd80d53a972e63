#pragma once

#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// A minimum of the distance between two spacecraft, as polynomials in the deviations of both: the
/// variables are the twelve standard normal numbers of the encounter, six for each spacecraft.
struct ClosestApproach {
  double time = 0;  ///< time of the closest approach of the means, after the epoch
  /// By how much later (or earlier) than this time the minimum comes, as a series without constant
  /// term.
  Series<double> delay;
  /// Relative position (three numbers) and velocity (three) at the minimum, the second spacecraft's
  /// minus the first's.
  std::vector<Series<double>> state;
  /// The square of the distance at the minimum.
  Series<double> squared_distance;
};

/// The minima of the distance between the means in the window, in the order of time; if there are
/// more than `most`, the nearest ones. A least distance at an end of the window does not count as a
/// minimum.
///
/// With rho and v the relative position and velocity, the condition rho.v = 0 is solved for the
/// time as a series, by the same partial inversion of series that gives a flow's momenta. Throws as
/// validate and integrate_gauss, and Error(too_large) for an order whose series in twelve variables
/// would be too long.
std::vector<ClosestApproach> closest_approaches(const EncounterProblem& problem,
                                                std::size_t most = 8);

/// The results of the formulas for a short encounter, which assume straight relative motion and
/// covariances that do not change meanwhile.
struct ShortEncounter {
  double time = 0;                 ///< time of the closest approach of the means, after the epoch
  double distance = 0;             ///< distance of the means at that time
  double speed = 0;                ///< relative speed of the means
  std::array<double, 2> offset{};  ///< means in the plane across the velocity, along the principal
                                   ///< axes of the covariance there
  /// Standard deviations of the relative position along these axes.
  std::array<double, 2> deviation{};
  /// The probability by the double integral over the disc in polar coordinates (J. L. Foster and H.
  /// S. Estes, NASA JSC-25898, 1992).
  double foster = 0;
  /// The probability by a single integral of error functions (S. Alfano, Journal of the
  /// Astronautical Sciences 53 (2005) 103).
  double alfano = 0;
  /// The probability by a series, for which the ellipse of deviations is replaced by a circle of
  /// the same area (F. K. Chan, Spacecraft Collision Probability, 2008).
  double chan = 0;
  /// The duration of the passage to each side of the closest approach: (radius + 3 standard
  /// deviations along the velocity) / speed.
  double passage = 0;
  /// Largest departure, during the passage, of the means from straight motion and of the standard
  /// deviations in the plane from constancy; in units of the least standard deviation and relative,
  /// respectively.
  double departure = 0;
  /// The window begins or ends during the passage, whereas the formulas assume the whole passage.
  bool is_cut = false;

  /// Whether the assumptions hold. A departure of a tenth of a standard deviation changes the
  /// exponent of a probability by a tenth at most.
  bool holds() const { return departure < largest_departure && !is_cut; }
  static constexpr double largest_departure = 0.1;
};

/// The formulas at one closest approach. Throws as closest_approaches, and Error(numerical) where
/// the relative velocity is zero or the covariance in the plane vanishes.
ShortEncounter short_encounter(const EncounterProblem& problem, double time_of_closest_approach);

}  // namespace hamjet
