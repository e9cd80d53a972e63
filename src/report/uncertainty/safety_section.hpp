#pragma once

#include "../../studies/uncertainty/safety_study.hpp"
#include "uncertainty_report.hpp"

namespace hamjet::io {

/// What a study of passive safety adds to the report of `hamjet uncertainty`: `safety` in
/// summary.json, lines of the terminal and the page, a chart of the least separations, and
/// `safety.csv` with a row for each pair and share of the burn.
UncertaintySection safety_section(const SafetyResult& result);

}  // namespace hamjet::io
