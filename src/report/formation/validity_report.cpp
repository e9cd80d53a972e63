#include <fmt/format.h>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/csv_values.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/chart_drawer.hpp"
#include "../study_checks.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_json.hpp"
#include "transfer_page.hpp"
#include "transfer_view.hpp"
#include "validity_json.hpp"
#include "validity_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string terminal_table(const ValidityResult& result) {
  const double unit = result.scene.units.time_s;
  const TimeAxis axis = time_axis(result.points.empty() ? 0 : result.points.back().time * unit);
  std::vector<std::vector<std::string>> rows = {{fmt::format("time ({})", axis.name)}};
  for (int order = 1; order <= result.scene.order; ++order) {
    rows[0].push_back(fmt::format("order {}", order));
  }
  bool has_limit = false;
  for (const ValidityPoint& point : result.points) {
    rows.push_back({fmt::format("{:.6g}", point.time * unit / axis.seconds)});
    for (const ValidityEntry& entry : point.entries) {
      has_limit |= entry.is_at_limit;
      rows.back().push_back((entry.is_at_limit ? ">" : "") + length_text(entry.proved_m));
    }
  }
  const std::string limit = reach_limit_text(result);
  return fmt::format(
             "{}\n{}\nframe {}\n\n{}", result.scene.title, validity_verdict(result),
             frame_text(result.scene.validity->frame) + coordinates_text(result.coordinates),
             aligned_table(rows)) +
         (has_limit ? "> still right at the largest separation tried\n" : "") +
         (limit.empty() ? "" : limit + "\n");
}

std::string terminal_details(const ValidityResult& result) {
  return fmt::format("{}; {} for the jets, {} to fly (floor {})\n",
                     counted(result.flights, "flight"), duration_text(result.propagation_seconds),
                     duration_text(result.proof_seconds), length_text(result.flight_floor_m));
}

/// A cell's value, null where it has none.
Json cell_json(const CellValue& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return json_number(*number);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

}  // namespace

Json validity_json(const ValidityResult& result) {
  const ValiditySettings& settings = *result.scene.validity;
  Json points = Json::array();
  for (const ValidityPoint& point : result.points) {
    Json entries = Json::array();
    for (const ValidityEntry& entry : point.entries) {
      Json order = {{"order", entry.order},
                    {"predicted_m", json_number(entry.predicted_m)},
                    {"proved_m", json_number(entry.proved_m)},
                    {"miss_m", json_number(entry.miss_m)},
                    {"at_limit", entry.is_at_limit}};
      for (const auto& [name, value] : limit_members(entry.limit)) order[name] = cell_json(value);
      entries.push_back(std::move(order));
    }
    points.push_back({{"time_canonical", told_time(result.scene, point.time)},
                      {"time_s", point.time * result.scene.units.time_s},
                      {"orders", entries}});
  }
  Json json = {{"tolerance_m", settings.tolerance_m}};
  add_coordinates(json, result.coordinates);
  json.update(Json{
      {"frame", frame_name(settings.frame)},
      {"derivatives", text_or_null(std::string(derivatives_name(settings.frame)))},
      {"axes", axis_letters(settings.frame)},
      {"semi_axes", settings.semi_axes},
      {"samples", settings.samples},
      {"verdict", validity_verdict(result)},
      {"times", points},
      {"flights", result.flights},
      {"flight_floor_m", json_number(result.flight_floor_m)},
      {"seconds", {{"propagation", result.propagation_seconds}, {"proof", result.proof_seconds}}}});
  return json;
}

Json validity_report_json(const ValidityResult& result) {
  Json summary = study_head_json(result.scene, "validity", result.integrator);
  summary["validity"] = validity_json(result);
  summary["exit_code"] = 0;
  return summary;
}

std::string validity_csv(const ValidityResult& result) {
  const RelativeFrame frame = result.scene.validity->frame;
  std::string text =
      "time_canonical,time_s,order,predicted_m,proved_m,miss_m,at_limit,frame,derivatives,"
      "coordinates,end_coordinates";
  for (const auto& [name, value] : limit_members({})) text += "," + name;
  text += '\n';
  for (const ValidityPoint& point : result.points) {
    for (const ValidityEntry& entry : point.entries) {
      text += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{}", csv_number(told_time(result.scene, point.time)),
          csv_number(point.time * result.scene.units.time_s), entry.order,
          csv_number(entry.predicted_m), csv_number(entry.proved_m), csv_number(entry.miss_m),
          entry.is_at_limit, frame_name(frame), derivatives_name(frame),
          name_of(result.coordinates.start), name_of(result.coordinates.end));
      for (const auto& [name, value] : limit_members(entry.limit)) {
        text += "," + csv_field(csv_text(value));
      }
      text += '\n';
    }
  }
  return text;
}

StudyReport validity_report(const ValidityResult& result, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"validity.csv", validity_csv(result)},
                  {"report.html", validity_page(result, origin, drawer)}};
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(validity_report_json(result)) + "\n"});
  report.table = terminal_table(result);
  report.details = terminal_details(result);
  add_checks(report, result.checks);
  return report;
}

}  // namespace hamjet::io
