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
/// Precondition: reason_without_charted_jet says nothing and the coordinates are not Cartesian.
ChartedJet charted_jet(const Scene& scene, const RunResult& run);

}  // namespace hamjet
