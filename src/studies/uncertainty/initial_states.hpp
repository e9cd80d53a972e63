#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/covariance.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// One spacecraft's distribution at the start.
struct InitialState {
  std::string name;
  Vector<double> mean;    ///< canonical deviation from the chief's nominal
  Covariance covariance;  ///< of canonical deviations
};

/// Those of the chief and of the deputy, as far as the scene has them, with the burn's errors in
/// the one that it belongs to. Of a burn that ended early a share is done: the rest of its velocity
/// change is missing, and its errors are as much smaller.
std::vector<InitialState> initial_states(const Scene& scene, double burn_share = 1);

/// A spacecraft relative to the chief in the frame of the scene's deputy, and known as well as
/// that, without a burn.
InitialState initial_deputy(const Scene& scene, const RelativeState& start);

/// An encounter in the scene's field and order, still without its spacecraft: the window and the
/// radius canonical. The jets of both have a tolerance of their own, whatever integrates the
/// scene's.
EncounterProblem empty_encounter(const Scene& scene, double from, double to, double radius);

/// One side of an encounter.
UncertainSpacecraft uncertain_spacecraft(const Scene& scene, const InitialState& start);

}  // namespace hamjet
