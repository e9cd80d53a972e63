#pragma once

#include "hamjet/detail/studies/energy_optimal.hpp"
#include "thrusted_flight.hpp"

namespace hamjet {

/// The law of feedback of one transfer at the scene's number of instants, and a flight by it. One
/// jet of states and costates about the coasting orbit is propagated from the arrival back through
/// the instants; its generating function F1 gives the costates at an instant for the state there
/// and the scene's end. A numerical failure is told in the result.
FeedbackLaw thrust_feedback(const Scene& scene, const ComputedProblem& problem,
                            const ThrustedFlight& flight, int panels);

}  // namespace hamjet
