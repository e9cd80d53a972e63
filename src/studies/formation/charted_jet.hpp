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
/// coefficient, relative to the largest of the degree, times error_estimate_safety, and never below
/// the rounding. For degree 0 it includes the error of the chief's final state, through which the
/// section at the end goes.
///
/// Precondition: reason_without_charted_jet has no value, and the coordinates are not Cartesian.
ChartedJet charted_jet(const Scene& scene, const RunResult& run);

/// Degrees of a flow box's polynomials that have no right digit, where its chart or rounding leaves
/// nothing but rounding of them.
struct DegreesWithoutDigits {
  /// Those whose coefficients or errors are a thousand millionth of degree 1's at most, of a jet in
  /// the chief's own units: on an ellipse of Kepler's problem degree 1 says all. What is relative
  /// to such coefficients says nothing.
  std::vector<int> of_rounding;
  /// The others, which are wrong.
  std::vector<int> wrong;

  /// Whether the Poisson brackets of a degree consist of products with degrees of rounding alone.
  bool has_rounding_alone(const SymplecticityDefect& defect) const;
};

/// The degrees from 2 on whose error estimate is at least their largest coefficient; where nothing
/// was estimated, those whose coefficients are below 2^13 roundings of degree 1's.
DegreesWithoutDigits degrees_without_digits(const Scene& scene, const ChartedJet& charted);

}  // namespace hamjet
