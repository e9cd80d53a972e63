#pragma once

#include <vector>

#include "stability.hpp"

namespace hamjet {

/// Orbits at the edges of the charts of flow boxes, as cases of a stability suite, each with its
/// right outcome: either deputies arrive where an independent integration flies them, to the
/// rounding that the flow amplifies, or the orbit is refused with a reason.
std::vector<StabilityCase> flow_box_cases();

/// Predicts four deputies of a case through its flow box. They are so near the chief that the
/// missing degrees contribute less than rounding. An explicit method, which shares no code with
/// flow boxes, flies them too. Returns the largest distance, the allowed one, and the chart of the
/// sections. Throws as FlowBoxPropagation.
MeasuredError flow_box_error(const FlowBoxCase& subject);

}  // namespace hamjet
