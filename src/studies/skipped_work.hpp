#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// A part of the work that was not done because the scene does not need it.
struct SkippedWork {
  std::string what;
  std::string why;
};

/// The scene's coordinates, if a run cannot write polynomials in them beside its jets.
std::optional<SkippedWork> unwritten_coordinates(const Scene& scene);
/// The scene's coordinates, if they are not Cartesian: a comparison uses jets in positions and
/// momenta.
std::optional<SkippedWork> uncompared_coordinates(const Scene& scene);

/// All work that `propagate` left out: coordinates, force terms, degrees of freedom, variables,
/// degrees, reference, inversions, figure, relative Hamiltonian, and each self-check that is off.
std::vector<SkippedWork> skipped_work(const PropagationResult& result);

}  // namespace hamjet
