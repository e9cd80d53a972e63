#pragma once

#include <optional>

#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// The problem with a window that holds the whole of the passages that its edges cut; none where
/// they cut none. The states of a conjunction data message are those of the closest approach
/// itself, so that a window from them on has half of the passage; a whole one begins before the
/// epoch.
///
/// On the straight line through the mean relative state at an edge the closest approach comes
///
///   tau = -rho.v / |v|^2
///
/// later, and they pass within (radius + s) / |v| of it to each side, s so many standard deviations
/// of the position along v: an edge is in a passage for s of five, and the whole one goes to nine.
/// Only what passes at a 50th of the orbital speed or more, in less than a 32nd of a local period,
/// and comes near the radius within nine standard deviations is a passage: others keep company.
/// Throws as validate and integrate_gauss.
std::optional<EncounterProblem> with_whole_passages(const EncounterProblem& problem);

}  // namespace hamjet
