#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Whether a run's tolerance bounds the error of every degree after one period of the linearised
/// motion, not a local error.
bool is_tolerance_of_jet(const RunResult& run);

/// The run's jet in units in which the comparison of coefficients does not depend on the unit of
/// length.
FlowJet<Extended> comparable_jet(const Scene& scene, const RunResult& run);

/// The estimated errors that are allowed for a run with a tolerance; see self_checks,
/// error-estimate.
struct PromisedErrors {
  double of_tolerance = 0;       ///< for each degree, by the tolerance alone
  std::vector<double> rounding;  ///< by degree, approximate effect of rounding alone
  std::vector<double> total;     ///< by degree, for the tolerance and for rounding
};

/// Precondition: the run has a tolerance and its jet.
PromisedErrors promised_errors(const Scene& scene, const RunResult& run);

/// Whether the run's error estimate exceeds the promised error at some degree, in a scene that sets
/// no limit of its own. Precondition: as for promised_errors.
bool exceeds_promise(const Scene& scene, const RunResult& run);

}  // namespace hamjet
