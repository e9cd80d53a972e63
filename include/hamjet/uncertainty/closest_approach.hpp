#pragma once

#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// A minimum of the distance between two spacecraft, as polynomials in the deviations of both: the
/// variables are the twelve standard normal numbers of the encounter, six for each spacecraft.
struct ClosestApproach {
  double time = 0;  ///< of the means, after the epoch
  /// By how much later (or earlier) the minimum comes, without a constant term.
  Series<double> delay;
  /// Relative position (three) and velocity (three) then, the second's less the first's.
  std::vector<Series<double>> state;
  /// The square of the distance.
  Series<double> squared_distance;
};

/// The minima of the distance between the means in the window, in the order of time; at most
/// `most` of them, the nearest. A minimum at an end of the window is none.
///
/// With rho and v the relative position and velocity, the condition rho.v = 0 is solved for the
/// time as a series: a partial inversion, as the paper inverts a flow for its momenta. Throws as
/// validate and integrate_gauss, and Error(too_large) for an order whose series in twelve variables
/// would be too long.
std::vector<ClosestApproach> closest_approaches(const EncounterProblem& problem,
                                                std::size_t most = 8);

/// What formulas make of an encounter that is short: straight relative motion, and covariances that
/// do not change during it.
struct ShortEncounter {
  double time = 0;                    ///< of the closest approach of the means, after the epoch
  double distance = 0;                ///< of the means then
  double speed = 0;                   ///< relative
  std::array<double, 2> offset{};     ///< of the means in the plane across the velocity, along the
  std::array<double, 2> deviation{};  ///< principal axes of the combined covariance in it
  /// The probability by the double integral over the disc in polar coordinates (J. L. Foster and H.
  /// S. Estes, NASA JSC-25898, 1992).
  double foster = 0;
  /// The same by a single integral of error functions (S. Alfano, Journal of the Astronautical
  /// Sciences 53 (2005) 103).
  double alfano = 0;
  /// By the series that takes the ellipse of deviations for a circle of the same area (F. K. Chan,
  /// Spacecraft Collision Probability, 2008).
  double chan = 0;
  /// The time in which the relative motion passes: (radius + 3 standard deviations along the
  /// velocity) / speed, to each side.
  double passage = 0;
  /// Within that time, the largest departure of the means from straight motion and of the standard
  /// deviations in the plane from constancy: in the least standard deviation, relative.
  double departure = 0;
  /// The window begins or ends while they pass: the formulas are about the whole passage.
  bool is_cut = false;

  /// A tenth of a standard deviation changes a probability by a tenth of its exponent or less.
  bool holds() const { return departure < largest_departure && !is_cut; }
  static constexpr double largest_departure = 0.1;
};

/// At one closest approach. Throws as closest_approaches, and Error(numerical) without relative
/// velocity or where the covariance vanishes in the plane.
ShortEncounter short_encounter(const EncounterProblem& problem, double time_of_closest_approach);

}  // namespace hamjet
