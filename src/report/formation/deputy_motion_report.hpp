#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/formation/deputy_motion.hpp"
#include "../drawing/chart.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// The first that a reader sees: how near and how far the deputy comes, and by how much the
/// polynomials are wrong.
std::string deputy_motion_verdict(const DeputyMotion& motion);

/// `motion.csv`: one row a time.
TableView deputy_motion_table(const DeputyMotion& motion);
inline std::vector<TableView> deputy_motion_tables(const DeputyMotion& motion) {
  return {deputy_motion_table(motion)};
}

/// The time of a point in seconds.
inline double seconds_at(const DeputyMotion& motion, std::size_t point) {
  return motion.points[point].time * motion.scene.units.time_s;
}

/// The relative position and the separation along time, not fitted.
Chart deputy_motion_chart(const DeputyMotion& motion);

/// The polynomials' errors along time, not fitted.
Chart deputy_motion_error_chart(const DeputyMotion& motion);

/// `summary.json`.
nlohmann::ordered_json deputy_motion_json(const DeputyMotion& motion);

/// The files of `hamjet motion`: `motion.csv`, `report.html`, `summary.json`.
StudyReport deputy_motion_report(const DeputyMotion& motion, const ReportOrigin& origin);

}  // namespace hamjet::io
