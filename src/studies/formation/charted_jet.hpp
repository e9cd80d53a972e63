#pragma once

#include <optional>
#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Why a run cannot write polynomials in the scene's coordinates; nothing where it can, or these
/// are Cartesian: those of `auto` are not known without measuring, and charts are of orbits in all
/// six variables, flow boxes of those in double precision.
std::optional<std::string> reason_without_charted_jet(const Scene& scene);

/// The polynomials of a run in the scene's coordinates, at the duration: flow boxes are integrated,
/// others made from the run's jet. What the orbit or the method lacks is said in its failure.
///
/// Where the scene estimates errors, flow boxes are integrated twice more, by Gauss methods of 16
/// and 15 stages to the rounding of the numbers, from starts moved by a unit in the last place, so
/// that all roundings are others. The estimate of degree d is the largest difference of a
/// coefficient, relative to the largest of the degree, times error_estimate_safety, and never below
/// that rounding; of degree 0 it is also that of the chief's final state, through which the section
/// at the end goes.
///
/// Precondition: reason_without_charted_jet says nothing and the coordinates are not Cartesian.
ChartedJet charted_jet(const Scene& scene, const RunResult& run);

}  // namespace hamjet
