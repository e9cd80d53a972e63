#pragma once

#include "../../store/table_view.hpp"
#include "../../studies/uncertainty/safety_study.hpp"

namespace hamjet::io {

/// A row for each pair and share of the burn.
TableView safety_table(const SafetyResult& result);

/// Whether the flight with the deviation that is told does not touch the ellipsoid.
bool is_in_doubt(const SafetyPair& pair);

}  // namespace hamjet::io
