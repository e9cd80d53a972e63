#include <fmt/format.h>

#include <algorithm>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "../drawing/chart_drawer.hpp"
#include "../drawing/report_page.hpp"
#include "../study_checks.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_charts.hpp"
#include "transfer_json.hpp"
#include "transfer_view.hpp"
#include "validity_table.hpp"
#include "validity_view.hpp"

// How far the polynomials reach in each of the coordinates, on the same deputies.

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

const ValidityEntry& last_entry(const ValidityResult& result, int order) {
  return result.points.back().entries[static_cast<std::size_t>(order - 1)];
}

std::string reach_text(const ValidityEntry& entry) {
  return (entry.is_at_limit ? ">" : "") + length_text(entry.proved_m);
}

std::string verdict(const ValidityInCoordinates& all) {
  const ValidityResult& cartesian = all.results.front();
  const ValidityResult& furthest = all.furthest();
  const int order = cartesian.scene.order;
  const double unit = cartesian.scene.units.time_s;
  const double plain = last_entry(cartesian, order).proved_m;
  std::string text =
      fmt::format("After {} the polynomials of order {} are right to {} up to {} in {} coordinates",
                  time_text(cartesian.points.back().time * unit), order,
                  length_text(cartesian.scene.validity->tolerance_m),
                  length_text(last_entry(furthest, order).proved_m), name_of(furthest.coordinates));
  if (furthest.coordinates != JetCoordinates::cartesian && plain > 0) {
    text += fmt::format(", {:.3g} times as far as the {} in positions and velocities",
                        last_entry(furthest, order).proved_m / plain, length_text(plain));
  }
  text += fmt::format(", proved by flying the same deputies, with velocities {}.",
                      velocities_text(cartesian.scene.validity->frame));
  for (const ValidityResult& result : all.results) {
    const std::string unproved = unproved_text(result);
    text += unproved;
    if (!unproved.empty()) break;  // what it says holds for all
  }
  for (const ValidityInCoordinates::Refused& refused : all.refused) {
    text += fmt::format(" Refused: {}.", refused.reason);
  }
  return text;
}

/// The head of the table and a row for each order, and one for the time of the jets.
std::vector<std::vector<std::string>> table_rows(const ValidityInCoordinates& all) {
  std::vector<std::vector<std::string>> rows = {{"order"}};
  for (const ValidityResult& result : all.results) {
    rows[0].emplace_back(name_of(result.coordinates));
  }
  for (int order = 1; order <= all.results[0].scene.order; ++order) {
    rows.push_back({std::to_string(order)});
    for (const ValidityResult& result : all.results) {
      rows.back().push_back(reach_text(last_entry(result, order)));
    }
  }
  rows.push_back({"jets"});
  for (const ValidityResult& result : all.results) {
    rows.back().push_back(duration_text(result.propagation_seconds));
  }
  return rows;
}

/// What limits the highest order at the last time, a row for each of the coordinates.
std::vector<std::vector<std::string>> limit_rows(const ValidityInCoordinates& all) {
  std::vector<std::vector<std::string>> rows = {
      {fmt::format("limits, order {}", all.results[0].scene.order), "reach"}};
  rows[0].insert(rows[0].end(), limit_head.begin(), limit_head.end());
  for (const ValidityResult& result : all.results) {
    const ValidityEntry& entry = last_entry(result, result.scene.order);
    rows.push_back({name_of(result.coordinates), reach_text(entry)});
    const std::vector<std::string> cells =
        entry.limit ? limit_cells(*entry.limit) : std::vector<std::string>(limit_head.size(), "-");
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  }
  return rows;
}

Chart reach_chart(std::string name, std::string title) {
  Chart chart;
  chart.name = std::move(name);
  chart.title = std::move(title);
  chart.y = logarithmic_axis("largest separation", AxisUnit::metres);
  return chart;
}

template <class Points>
void add_curves(const ValidityInCoordinates& all, Chart& chart, const Points& points) {
  for (std::size_t k = 0; k < all.results.size(); ++k) {
    ChartCurve curve;
    curve.title = name_of(all.results[k].coordinates);
    curve.style = k;
    curve.points = points(all.results[k]);
    chart.curves.push_back(std::move(curve));
  }
}

Chart order_chart(const ValidityInCoordinates& all) {
  Chart chart = reach_chart("reach-order", "Reach against order");
  chart.x.label = "order of the polynomial";
  chart.x.is_integer = true;
  chart.x.margin = 0.04;
  add_curves(all, chart, [](const ValidityResult& result) {
    std::vector<std::pair<double, double>> points;
    for (const ValidityEntry& entry : result.points.back().entries) {
      points.emplace_back(entry.order, entry.proved_m);
    }
    return points;
  });
  chart.reading =
      "How far from the chief a deputy may be at the start so that the polynomials in each of the "
      "coordinates still say, within the tolerance, where it is at the last time. All are proved "
      "on the same deputies.";
  return chart;
}

Chart time_chart(const ValidityInCoordinates& all) {
  const Scene& scene = all.results[0].scene;
  Chart chart = reach_chart("reach-time", "Reach along time");
  const TimeAxis axis = time_axis(scene.validity->times.back() * scene.units.time_s);
  chart.x.label = fmt::format("time ({})", axis.name);
  add_revolutions(scene, axis.seconds, chart.x);
  add_curves(all, chart, [&](const ValidityResult& result) {
    std::vector<std::pair<double, double>> points;
    for (const ValidityPoint& point : result.points) {
      points.emplace_back(point.time * scene.units.time_s / axis.seconds,
                          point.entries.back().proved_m);
    }
    return points;
  });
  chart.reading = fmt::format("The same along time, of order {}.", scene.order);
  return chart;
}

std::string page_of(const ValidityInCoordinates& all, const ReportOrigin& origin,
                    ChartDrawer& drawer) {
  const Scene& scene = all.results[0].scene;
  ReportPage page;
  page.title = scene.title + ": reach of the polynomials by coordinates";
  page.verdict = verdict(all);
  Chart first = order_chart(all);
  fit(first);
  page.first_figure = figure_html(first, drawer);
  page.facts = origin_facts_html(origin) +
               fact_html("Scene", fmt::format("{}, order {}", scene.name, scene.order)) +
               fact_html("Frame", frame_text(scene.validity->frame)) +
               fact_html("Tolerance", length_text(scene.validity->tolerance_m));
  page.sections = table_html(
      "The largest separation at the last time by order and coordinates, and what the jets up to "
      "there take. Flow-box coordinates are integrated in four or five variables of their own; the "
      "others are made from the Cartesian jet.",
      table_rows(all));
  page.sections += table_html(
      "What limits the highest order at the last time: the degree of the separation in which the "
      "worst deputy's miss grows there, and how much of it is of the coordinate of its deviation "
      "that has most; how much of the miss is in the coordinate of the end in which the "
      "polynomials are furthest off.",
      limit_rows(all));
  if (all.results[0].points.size() > 1) {
    Chart along = time_chart(all);
    fit(along);
    page.sections += section_html(along, drawer);
  }
  return page_html(page, drawer);
}

}  // namespace

StudyReport coordinates_report(const ValidityInCoordinates& all, const ReportOrigin& origin) {
  const Scene& scene = all.results.front().scene;
  Json summary = study_head_json(scene, "validity", all.results.front().integrator);
  summary["verdict"] = verdict(all);
  summary["coordinates"] = Json::array();
  std::string csv;
  for (const ValidityResult& result : all.results) {
    summary["coordinates"].push_back(validity_json(result));
    const std::string rows = table_csv(validity_table(result));
    csv += csv.empty() ? rows : rows.substr(rows.find('\n') + 1);
  }
  summary["refused"] = Json::array();
  for (const ValidityInCoordinates::Refused& refused : all.refused) {
    summary["refused"].push_back(
        {{"coordinates", name_of(refused.coordinates)}, {"reason", refused.reason}});
  }
  summary["exit_code"] = 0;
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"validity.csv", csv}, {"report.html", page_of(all, origin, drawer)}};
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(summary) + "\n"});
  report.table = fmt::format("{}\n{}\nframe {}; reach after {}\n\n{}\n{}", scene.title,
                             verdict(all), frame_text(scene.validity->frame),
                             time_text(scene.validity->times.back() * scene.units.time_s),
                             aligned_table(table_rows(all)), aligned_table(limit_rows(all)));
  add_checks(report, all.checks);
  return report;
}

}  // namespace hamjet::io
