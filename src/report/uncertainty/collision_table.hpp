#pragma once

#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/uncertainty/collision_study.hpp"

namespace hamjet::io {

/// What a study of collisions found, and the probability along time.
TableView collision_table(const CollisionResult& result);
/// The probability of the whole passages, which is that of the window where no edge cuts one.
TableView whole_passage_table(const CollisionResult& result);
/// Quantiles of the least separation in the window.
TableView least_separation_table(const CollisionResult& result);
/// A row for each closest approach of the means.
TableView approaches_table(const CollisionResult& result);
/// The formulas for short encounters, a row for each closest approach.
TableView short_encounter_table(const CollisionResult& result);

/// All of them.
std::vector<TableView> collision_tables(const CollisionResult& result);

}  // namespace hamjet::io
