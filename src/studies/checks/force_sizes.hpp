#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// One force of the model `earth`, and what a scene would be without it.
struct ForceSize {
  std::string name;         ///< for people: "tesseral harmonics", "Sun", ...
  std::string key;          ///< how a scene leaves it out: "gravity_order = 0", ...
  double largest_m_s2 = 0;  ///< the force's largest acceleration along the chief's orbit
  double chief_m = 0;       ///< the largest change of the chief's position without it
  /// The largest change of the deputy's position relative to the chief; no value without a deputy.
  std::optional<double> relative_m = {};
};

/// Flies the chief, and the deputy where there is one, over the scene's duration with all forces
/// and again without each of them, and compares at equal times. The last row of a deputy in shadows
/// is what it leaves out that its light is that of its chief. Empty for other models. Throws as
/// exact_flow.
std::vector<ForceSize> force_sizes(const Scene& scene);

/// The drag on the chief at its start; 0 for scenes without air.
double drag_m_s2(const Scene& scene);

}  // namespace hamjet
