#pragma once

#include <vector>

#include "../report/drawing/chart.hpp"
#include "sweep_report.hpp"

namespace hamjet::io {

/// The number in a row's column, if there is one and the row is there.
std::optional<double> sweep_number(const std::optional<SweepRow>& row, std::size_t column);

/// The map that a study asks for. Where several items have the same place, the least value counts.
Chart sweep_map(const SweepStudy& study, const SweepRows& rows);

}  // namespace hamjet::io
