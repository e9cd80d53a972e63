#pragma once

#include <vector>

#include "hamjet/studies/assignment.hpp"

namespace hamjet {

/// The least separation of each pair of the assigned deputies while all fly: from the start to the
/// last arrival, after their own arrival with the velocity that they are brought to. All are flown
/// with the full equations of motion, and no look between the steps of the flight is left out, see
/// ExtremeDistance. Transfers without an answer are left out. Throws as fly_arcs.
std::vector<DeputyPair> nearest_of_pairs(const Scene& scene,
                                         const std::vector<AssignedTransfer>& transfers);

}  // namespace hamjet
