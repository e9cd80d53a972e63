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

/// What a run makes of `jet.coordinates`: its jets are in positions and momenta, whatever the key
/// says. Nothing where it says just that.
std::optional<SkippedWork> unused_coordinates(const Scene& scene);

/// All that `propagate` left out: coordinates, force terms, degrees of freedom, variables, degrees,
/// reference, inversions, figure, relative Hamiltonian, and each self-check that is off.
std::vector<SkippedWork> skipped_work(const PropagationResult& result);

}  // namespace hamjet
