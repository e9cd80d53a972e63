#pragma once

#include <optional>
#include <string>

#include "../../studies/uncertainty/collision_study.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"

namespace hamjet::io {

/// What a scene or its result lacks for a Conjunction Data Message, as the end of "no message: ";
/// none if it can be one. A CDM dates in UTC and has axes that the standard knows (CCSDS
/// 508.0-B-1, tables 3-2 and 3-3).
std::optional<std::string> encounter_message_lack(const Scene& scene,
                                                  const CollisionResult& result);

/// The nearest approach of the means as a Conjunction Data Message: states and linear covariances
/// then, and the probability of the whole window. Nothing must be lacking.
ConjunctionDataMessage encounter_message(const Scene& scene, const CollisionResult& result);

}  // namespace hamjet::io
