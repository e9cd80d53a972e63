#pragma once

#include <vector>

#include "feedback_costates.hpp"
#include "hamjet/detail/studies/energy_optimal.hpp"
#include "hamjet/detail/studies/progress.hpp"

namespace hamjet {

/// Flights under errors that are drawn anew for each instant of the law of feedback, as the scene's
/// ThrustErrorSettings say. In the closed loop the controller asks the law with the deputy's state
/// plus the navigation error of the instant, and flies that state and its costates until the next
/// one; in the open loop it flies the answer with these costates at the start. The deputy carries
/// out what is commanded with the thrust error of the instant, the same in both. All is flown with
/// the full equations of motion, those of `orbit`; `panels` are those of a whole flight's integrals
/// (fly_on).
std::vector<ErrorSample> erroneous_flights(const Scene& scene, const ComputedProblem& orbit,
                                           const ThrustedFlight& flight, FeedbackCostates& law,
                                           const std::vector<double>& costates, int panels,
                                           const ProgressCallback& progress);

}  // namespace hamjet
