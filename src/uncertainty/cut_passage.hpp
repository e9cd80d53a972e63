#pragma once

#include <optional>

#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// The problem with a window that contains the whole of the passages that its edges cut; no value
/// where they cut none. The states of a conjunction data message are those at the closest approach
/// itself, so that a window that starts there contains half of the passage; the whole passage
/// begins before the epoch.
///
/// On the straight line through the mean relative state at an edge, the closest approach comes
/// later by
///   tau = -rho.v / |v|^2 ,
///
/// and the passage takes (radius + s) / |v| to each side, where s is some number of standard
/// deviations of the position along v. An edge is in a passage if it is so for five standard
/// deviations, and the window is extended to nine. Only an encounter whose half takes less than an
/// eighth of a local period, in which the line bends little, and that comes near the radius within
/// nine standard deviations counts as a passage; slower pairs keep company. Throws as validate and
/// integrate_gauss.
std::optional<EncounterProblem> with_whole_passages(const EncounterProblem& problem);

}  // namespace hamjet
