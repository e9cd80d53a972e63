#pragma once

#include <optional>
#include <string>

#include "../../studies/uncertainty/collision_study.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"

namespace hamjet::io {

/// What a scene or its result lacks for a Conjunction Data Message, as the end of "no message: ";
/// no value if nothing is lacking. A CDM gives dates in UTC and states in axes that the standard
/// lists (CCSDS 508.0-B-1, tables 3-2 and 3-3).
std::optional<std::string> encounter_message_lack(const Scene& scene,
                                                  const CollisionResult& result);

/// The nearest approach of the means as a Conjunction Data Message: the states and linear
/// covariances at that time, and the probability over the whole window. Precondition: nothing is
/// lacking (see encounter_message_lack).
ConjunctionDataMessage encounter_message(const Scene& scene, const CollisionResult& result);

}  // namespace hamjet::io
