#pragma once

#include <vector>

#include "stability.hpp"

namespace hamjet {

/// Orbits at the edges of the charts of flow boxes, as cases of a stability suite, with what is
/// right for each: deputies go where an independent integration flies them, to the rounding that
/// the flow itself amplifies, or the orbit is refused with the reason.
std::vector<StabilityCase> flow_box_cases();

/// Predicts four deputies of a case through its flow box, so near the chief that what the missing
/// degrees would add is rounding, and flies them by an explicit method, which shares no code with
/// flow boxes: their largest distance and what is allowed, in which chart of sections. Throws as
/// FlowBoxPropagation.
MeasuredError flow_box_error(const FlowBoxCase& subject);

}  // namespace hamjet
