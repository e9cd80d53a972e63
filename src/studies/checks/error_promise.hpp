#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Whether a run's tolerance bounds the error of every degree after one period of the linearised
/// motion, not a local error.
bool is_tolerance_of_jet(const RunResult& run);

/// The run's jet, whose coefficients are comparable whatever the unit of length.
FlowJet<Extended> comparable_jet(const Scene& scene, const RunResult& run);

/// The estimated errors that a run with a tolerance may have; see self_checks, error-estimate.
struct PromisedErrors {
  double of_tolerance = 0;       ///< of each degree, for the tolerance alone
  std::vector<double> rounding;  ///< by degree, about what rounding alone makes
  std::vector<double> total;     ///< by degree, for the tolerance and for rounding
};

/// Precondition: the run has a tolerance and its jet.
PromisedErrors promised_errors(const Scene& scene, const RunResult& run);

/// Whether the run's error estimate exceeds what is promised at some degree, in a scene that sets
/// no limit of its own. Precondition: as of promised_errors.
bool exceeds_promise(const Scene& scene, const RunResult& run);

}  // namespace hamjet
