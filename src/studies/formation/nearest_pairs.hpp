#pragma once

#include <vector>

#include "hamjet/studies/assignment.hpp"

namespace hamjet {

/// The least separation of each pair of assigned deputies while all fly: from the start to the last
/// arrival. After its own arrival a deputy flies on with the velocity that it was given. All are
/// flown with the full equations of motion, and nothing between the steps is missed, see
/// ExtremeDistance. Transfers without an answer are left out. Throws as fly_arcs.
std::vector<DeputyPair> nearest_of_pairs(const Scene& scene,
                                         const std::vector<AssignedTransfer>& transfers);

}  // namespace hamjet
