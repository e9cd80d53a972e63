#pragma once

#include <string>

#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {

// Sections of the page, in HTML.

/// The time that each series needs for some relative errors, as ratios to the best.
std::string reach_table_html(const ComparisonResult& result);
/// All runs: cost, error, defects and corner; failed and left-out ones with the reason.
std::string run_table_html(const ComparisonResult& result);
/// All runs of the comparison: error and exactness residual of each degree side by side.
std::string degree_table_html(const ComparisonResult& result);
/// The runs of the cost against order.
std::string cost_table_html(const ComparisonResult& result);
/// Fitted orders and what theory says.
std::string fit_table_html(const ComparisonResult& result);
/// How the reference was made and how far it can be trusted.
std::string reference_html(const ComparisonResult& result);

}  // namespace hamjet::io
