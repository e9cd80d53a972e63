#pragma once

#include "hamjet/detail/studies/energy_optimal.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "thrusted_flight.hpp"

namespace hamjet {

/// The law of feedback of one transfer at the scene's number of instants, and flights by it: one
/// without errors, and those under the scene's errors beside the open loop, which is the flight
/// with these costates at the start. `orbit` is the problem without costates. A numerical failure
/// is told in the result.
FeedbackLaw thrust_feedback(const Scene& scene, const ComputedProblem& orbit,
                            const ComputedProblem& problem, const ThrustedFlight& flight,
                            const std::vector<double>& costates, int panels,
                            const ProgressCallback& progress);

}  // namespace hamjet
