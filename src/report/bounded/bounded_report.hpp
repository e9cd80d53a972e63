#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/bounded/bounded_formation.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// The first that a reader sees: how long the deputies stay, and how much better than by theories
/// of first order.
std::string bounded_verdict(const BoundedFormation& formation);

/// A row a deputy.
TableView bounded_table(const BoundedFormation& formation);
/// That, and the table of the box where the scene has one.
std::vector<TableView> bounded_tables(const BoundedFormation& formation);

/// `summary.json`.
nlohmann::ordered_json bounded_json(const BoundedFormation& formation);

/// The files of `hamjet bounded`: `bounded.csv`, `report.html`, `summary.json`, and `box.csv` of a
/// scene with a box. Exit code 4 where no size has a deputy, 1 where the box was left.
StudyReport bounded_report(const BoundedFormation& formation, const ReportOrigin& origin);

}  // namespace hamjet::io
