#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The reason why a run cannot write polynomials in the scene's coordinates; no value if it can, or
/// if the coordinates are Cartesian. Coordinates of `auto` are not known without measuring; charts
/// need an orbit in all six variables, and flow boxes also double precision.
std::optional<std::string> reason_without_charted_jet(const Scene& scene);

/// The polynomials of a run in the scene's coordinates, at the duration. Flow boxes are integrated;
/// polynomials in other coordinates are made from the run's jet. If the orbit or the method does
/// not allow it, `failure` gives the reason.
///
/// Where the scene estimates errors, flow boxes are integrated twice more, by Gauss methods of 16
/// and 15 stages to the rounding of the numbers, from starts moved by a unit in the last place, so
/// that all roundings are different. The estimate of degree d is the largest difference of a
/// coefficient, relative to the largest of the degree, and never below the rounding. For degree 0 it
/// includes the error of the chief's final state, through which the section at the end goes.
///
/// Precondition: reason_without_charted_jet has no value, and the coordinates are not Cartesian.
ChartedJet charted_jet(const Scene& scene, const RunResult& run);

/// Degrees of a flow box's polynomials, from 2 on, of which no digit is right. What is relative to
/// their coefficients says nothing.
struct DegreesWithoutDigits {
  /// Those whose coefficients and errors are below a millionth of degree 1's, of a jet in the
  /// chief's own units: on an ellipse of Kepler's problem degree 1 says all, and others are errors
  /// alone.
  std::vector<int> negligible;
  double largest_share = 0;  ///< largest ratio of these coefficients and errors to degree 1's
  std::vector<int> wrong;    ///< the others

  /// Whether the Poisson brackets of a degree consist of products with negligible degrees alone.
  bool are_behind(const SymplecticityDefect& defect) const;
};

/// A degree has no digits where its error estimate is at least its largest coefficient, or where
/// the Poisson brackets that have it with degree 1 do not vanish beside their own terms.
DegreesWithoutDigits degrees_without_digits(const Scene& scene, const ChartedJet& charted);

}  // namespace hamjet
