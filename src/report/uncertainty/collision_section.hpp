#pragma once

#include "../../studies/uncertainty/collision_study.hpp"
#include "uncertainty_report.hpp"

namespace hamjet::io {

/// What a study of collisions adds to the report of `hamjet uncertainty`: `collision` in
/// summary.json, lines of the terminal, a chart of the probability along time, and `collision.csv`
/// with its numbers.
UncertaintySection collision_section(const Scene& scene, const CollisionResult& result);

}  // namespace hamjet::io
