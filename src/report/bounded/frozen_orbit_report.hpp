#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/bounded/frozen_orbit_study.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// The first that a reader sees: the frozen orbit, and whether it is stable.
std::string frozen_orbit_verdict(const FrozenOrbitStudy& study);

/// A row a circle of the normal form, and what is told of the frozen orbit itself.
std::vector<TableView> poincare_tables(const FrozenOrbitStudy& study);

/// `summary.json`.
nlohmann::ordered_json frozen_orbit_json(const FrozenOrbitStudy& study);

/// The files of `hamjet poincare`: `poincare.csv`, `report.html`, `summary.json`.
StudyReport frozen_orbit_report(const FrozenOrbitStudy& study, const ReportOrigin& origin);

}  // namespace hamjet::io
