#pragma once

#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/periodic/periodic_study.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// The first that a reader sees: the orbit, or how far the family reaches.
std::string periodic_verdict(const PeriodicStudy& study);

/// A row an orbit.
std::vector<TableView> periodic_tables(const PeriodicStudy& study);

/// The files of `hamjet periodic`: `periodic.csv`, `report.html`, `summary.json`. A family whose
/// search failed before its end has exit code 4.
StudyReport periodic_report(const PeriodicStudy& study, const ReportOrigin& origin);

}  // namespace hamjet::io
