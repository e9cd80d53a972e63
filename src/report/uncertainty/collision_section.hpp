#pragma once

#include "../../studies/uncertainty/collision_study.hpp"
#include "uncertainty_report.hpp"

namespace hamjet::io {

/// What a study of collisions adds to the report of `hamjet uncertainty`: `collision` in
/// summary.json, lines of the terminal, a chart of the probability along time, `collision.csv`
/// with its numbers, and `encounter.cdm` or a word on what a Conjunction Data Message lacks.
UncertaintySection collision_section(const Scene& scene, const CollisionResult& result);

}  // namespace hamjet::io
