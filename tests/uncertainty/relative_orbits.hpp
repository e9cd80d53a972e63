#pragma once

#include <cmath>
#include <numbers>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet::test {

/// Two spacecraft about a centre with mu = 1, the first on the circle of radius 1. The second flies
/// relative to it, to first order in its distance (G. W. Hill; W. H. Clohessy and R. S. Wiltshire),
/// as eccentricity and inclination vectors of these sizes have it, without a drift:
///
///   R = -e cos t,  T = offset + 2 e sin t,  N = i sin(t + phase) ,
///
/// parallel at phase 0 and perpendicular at a quarter turn (S. D'Amico and O. Montenbruck, Journal
/// of Guidance, Control, and Dynamics 29 (2006) 554). What is left out is of second order: of the
/// part `offset` of what is told.
struct RelativeOrbit {
  double eccentricity = 0, inclination = 0, phase = 0, offset = 0;

  /// Of nothing that is uncertain, in a window from the epoch.
  EncounterProblem problem(double to, int order) const {
    EncounterProblem result{kepler(), {}, ClockTime::epoch()};
    result.from = 0;
    result.to = to;
    result.order = order;
    result.settings.tolerance = 1e-12;
    result.spacecraft[0].state = {1, 0, 0, 0, 1, 0};
    const double r = -eccentricity, n = inclination * std::sin(phase);
    // Inertial velocities: those in axes that turn at the rate 1, and the turn.
    result.spacecraft[1].state = {
        1 + r, offset, n, 0 - offset, 1 + 2 * eccentricity + r, inclination * std::cos(phase)};
    return result;
  }

  /// A deviation of the offset alone, as a column of the second spacecraft's factor.
  static Eigen::Matrix<double, 6, 1> along_the_orbit(double sigma) {
    Eigen::Matrix<double, 6, 1> column;
    column << 0, sigma, 0, -sigma, 0, 0;
    return column;
  }
};

}  // namespace hamjet::test
