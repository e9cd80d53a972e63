#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// One spacecraft's distribution at the start.
struct InitialState {
  std::string name;
  Vector<double> mean;    ///< canonical deviation from the chief's nominal
  Covariance covariance;  ///< of canonical deviations
};

/// Those of the chief and of the deputy, as far as the scene has them, with the burn's errors in
/// the one that it belongs to.
std::vector<InitialState> initial_states(const Scene& scene);

}  // namespace hamjet
