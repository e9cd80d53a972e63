#pragma once

#include <optional>
#include <string>

#include "../drawing/chart_drawer.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// `report.html` of a transfer study.
std::string transfer_page(const TransferResult& result,
                          const std::optional<RelativeTrajectory>& trajectory,
                          const ReportOrigin& origin, ChartDrawer& drawer);

/// `report.html` of a validity study.
std::string validity_page(const ValidityResult& result, const ReportOrigin& origin,
                          ChartDrawer& drawer);

// Sections of the pages, in HTML.

/// The validity against order, and the table of all times.
std::string validity_sections_html(const ValidityResult& result, ChartDrawer& drawer);
/// The best transfer: impulses along the axes, order by order.
std::string best_transfer_table_html(const TransferResult& result);
/// Misses of each order away from singularities.
std::string miss_table_html(const TransferResult& result);
/// The times at which F1 does not exist, and the direction that is lost there.
std::string singular_table_html(const TransferResult& result);
/// All transfer times.
std::string transfers_table_html(const TransferResult& result);
/// Seconds spent in the parts of the study.
std::string seconds_table_html(const TransferResult& result);

}  // namespace hamjet::io
