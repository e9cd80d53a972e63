#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "stability.hpp"

namespace hamjet {

/// Errors of a case's first run relative to the case's expectations, one for each quantity: the
/// worst component of the state, of the matrix, of each degree of the twin's jet, and so on. Throws
/// Error(usage) if the expectation does not fit the scene, and as `propagate` for further runs that
/// are needed.
std::vector<MeasuredError> measure_errors(const StabilityExpectation& expected,
                                          const PropagationResult& result,
                                          const ProgressCallback& progress);

}  // namespace hamjet
