#pragma once

#include <vector>

#include "../../studies/uncertainty/collision_study.hpp"
#include "uncertainty_arrays.hpp"

namespace hamjet::io {

/// A study of collisions as arrays: `probability`, `interval` (2), `standard_error`, `samples`,
/// `hits`, `equivalent_samples` and `change_from_lower_order`; `times_s` and `by_time` (201);
/// `separation_shares` and `separations_m` (4), `separation_intervals_m` (4, 2); and of the nearest
/// approach of the means, NaN without one, `approach_time_s`, `approach_distance_m`,
/// `approach_speed_m_s`, and by the formulas for short encounters `foster`, `alfano`, `chan` and
/// `short_encounter_departure`.
std::vector<NumberArray> collision_arrays(const CollisionResult& result);

}  // namespace hamjet::io
