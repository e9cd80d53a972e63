#pragma once

#include <vector>

#include "hamjet/studies/assignment.hpp"

namespace hamjet {

/// The least separation of each pair of the assigned deputies while all fly: from the start to the
/// last arrival, after their own arrival with the velocity that they are brought to. All are flown
/// with the full equations of motion; between the times flown to, at least 64 a revolution, cubic
/// interpolation of the places relative to the chief finds the least, to some 1e-6 of the distance
/// from the chief. Transfers without an answer are left out. Throws as exact_flow.
std::vector<DeputyPair> nearest_of_pairs(const Scene& scene,
                                         const std::vector<AssignedTransfer>& transfers);

}  // namespace hamjet
