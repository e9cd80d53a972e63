#include "frozen_orbit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../store/columns.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/bounded/scene_gauss.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "../formation/transfer_json.hpp"
#include "../study_checks.hpp"
#include "frozen_orbit_charts.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees = 180 / std::numbers::pi;

std::vector<std::vector<std::string>> circles_rows(const FrozenOrbitStudy& study) {
  std::vector<std::vector<std::string>> rows = {
      {"amplitude", "turns a revolution", "revolutions a turn", "nodal period (s)",
       "node (deg a revolution)",
       fmt::format("miss ({})", counted(study.flown_revolutions, "revolution"))}};
  for (const LibrationCircle& circle : study.circles) {
    rows.push_back(
        {length_text(study.length_m(circle.amplitude)) + (circle.is_chiefs ? " (chief)" : ""),
         fmt::format("{:.9g}", circle.rotation_number),
         fmt::format("{:.6g}", 1 / std::abs(circle.rotation_number)),
         fmt::format("{:.9g}", circle.mean_period * study.scene.units.time_s),
         fmt::format("{:.9g}", circle.mean_node * degrees),
         circle.miss ? fmt::format("{:.2e}", *circle.miss) : std::string()});
  }
  return rows;
}

std::string frozen_orbit_page(const FrozenOrbitStudy& study, const ReportOrigin& origin,
                              ChartDrawer& drawer) {
  ReportPage page;
  page.title = study.scene.title + ": frozen orbit";
  page.verdict = frozen_orbit_verdict(study);
  const auto drawn = [&](Chart chart) {
    fit(chart);
    return chart;
  };
  const Chart multipliers = drawn(multiplier_chart(study));
  page.first_figure = figure_html(
      study.circles.empty() ? multipliers : drawn(invariant_curve_chart(study)), drawer);
  page.facts =
      origin_facts_html(origin) +
      fact_html("Scene", fmt::format("{}, order {}", study.scene.name, study.scene.order)) +
      fact_html("Return", duration_text(study.nodal_period * study.scene.units.time_s)) +
      fact_html("Moved by a return", fmt::format("{:.1e}", study.residual)) +
      fact_html("Trace less 2", fmt::format("{:.9g}", study.trace_less_2));
  if (!study.circles.empty()) {
    page.sections = section_html(multipliers, drawer) +
                    section_html(drawn(frequency_chart(study)), drawer) +
                    section_html(drawn(reach_chart(study)), drawer) +
                    "<section>\n<h2>Circles of the normal form</h2>\n" +
                    table_html(
                        "Of each amplitude: how fast orbits turn about the frozen one, their "
                        "mean nodal period and advance of the node, and how far a flown one "
                        "is from where the normal form has it, in parts of the amplitude.",
                        circles_rows(study)) +
                    "</section>\n";
  }
  return page_html(page, drawer);
}

}  // namespace

std::string frozen_orbit_verdict(const FrozenOrbitStudy& study) {
  const auto [real, imaginary] = study.multiplier();
  std::string text = fmt::format(
      "The frozen orbit of the chief's energy and angular momentum about the axis has, osculating "
      "where the chief starts, a = {:.7g} km, e = {:.6g}, i = {:.7g} deg and its perigee at {:.6g} "
      "deg, returns after {:.10g} s, and a revolution moves it by {:.1e} of the canonical unit. ",
      study.semi_major_axis * study.scene.units.length_km, study.eccentricity,
      study.inclination_deg, study.pericentre_deg, study.nodal_period * study.scene.units.time_s,
      study.residual);
  if (study.is_inside_body()) {
    text += fmt::format(
        "It is no orbit that can be flown: its perigee lies {} below the body's radius. ",
        length_text(study.pericentre_depth * study.scene.units.length_km * 1000));
  }
  if (!study.is_stable()) {
    return text + fmt::format(
                      "It is unstable: its multipliers are {:.10g} and its inverse, so "
                      "that neighbours leave it by a factor of e in {:.4g} revolutions.",
                      real, 1 / std::log(std::abs(real)));
  }
  text += fmt::format("It is stable: its multipliers are {:.10g} +- {:.6g} i", real, imaginary);
  if (!study.failure.empty()) return text + "; " + study.failure + ".";
  text += fmt::format(
      ", and neighbours turn about it in {:.6g} revolutions; the normal form of order {} is right "
      "to {} of the amplitude up to {} (flown over {}).",
      1 / std::abs(study.circles.front().rotation_number), study.scene.order,
      FrozenOrbitStudy::largest_miss, length_text(study.length_m(study.reach)),
      counted(study.flown_revolutions, "revolution"));
  const bool has_chiefs = std::any_of(study.circles.begin(), study.circles.end(),
                                      [](const LibrationCircle& one) { return one.is_chiefs; });
  if (!has_chiefs) {
    text +=
        " The scene's chief is on none of its circles: it is further away than the normal form "
        "reaches.";
  }
  return text;
}

std::string frozen_orbit_csv(const FrozenOrbitStudy& study) {
  Columns<LibrationCircle> columns;
  const double unit = study.scene.units.time_s;
  columns.add("amplitude_m",
              [&](const LibrationCircle& circle) { return study.length_m(circle.amplitude); });
  columns.add("amplitude_eccentricity", &LibrationCircle::amplitude);
  columns.add("chief", &LibrationCircle::is_chiefs);
  columns.add("rotation_number", &LibrationCircle::rotation_number);
  columns.add("mean_nodal_period_s",
              [=](const LibrationCircle& circle) { return circle.mean_period * unit; });
  columns.add("node_deg_per_revolution",
              [](const LibrationCircle& circle) { return circle.mean_node * degrees; });
  const CanonicalFactors told = told_factors(study.scene);
  columns.add("action_canonical",
              [=](const LibrationCircle& circle) { return told.told_action(circle.action); });
  columns.add("miss", &LibrationCircle::miss);
  return columns.csv(study.circles);
}

Json frozen_orbit_json(const FrozenOrbitStudy& study) {
  const auto [real, imaginary] = study.multiplier();
  const CanonicalFactors told = told_factors(study.scene);
  Json json = study_head_json(study.scene, "poincare", scene_gauss_label(study.scene));
  json["verdict"] = frozen_orbit_verdict(study);
  json["frozen_orbit"] = {{"state_canonical", told_state(study.scene, study.state)},
                          {"a_km", study.semi_major_axis * study.scene.units.length_km},
                          {"e", study.eccentricity},
                          {"i_deg", study.inclination_deg},
                          {"argp_deg", study.pericentre_deg},
                          {"inside_body", study.is_inside_body()},
                          {"nodal_period_s", study.nodal_period * study.scene.units.time_s},
                          {"node_deg_per_revolution", study.node * degrees},
                          {"residual", study.residual},
                          {"iterations", study.iterations},
                          {"trace", study.trace},
                          {"trace_less_2", study.trace_less_2},
                          {"multiplier", {real, imaginary}},
                          {"area_defect", study.area_defect},
                          {"stable", study.is_stable()}};
  const bool has_form = study.failure.empty();
  json["failure"] = text_or_null(study.failure);
  json["smallest_divisor"] = has_form ? Json(study.smallest_divisor) : Json(nullptr);
  json["flown_revolutions"] = has_form ? Json(study.flown_revolutions) : Json(nullptr);
  json["reach_m"] = has_form ? Json(study.length_m(study.reach)) : Json(nullptr);
  json["largest_miss"] = FrozenOrbitStudy::largest_miss;
  json["circles"] = Json::array();
  for (const LibrationCircle& circle : study.circles) {
    json["circles"].push_back(
        {{"amplitude_m", study.length_m(circle.amplitude)},
         {"amplitude_eccentricity", circle.amplitude},
         {"chief", circle.is_chiefs},
         {"rotation_number", circle.rotation_number},
         {"mean_nodal_period_s", circle.mean_period * study.scene.units.time_s},
         {"node_deg_per_revolution", circle.mean_node * degrees},
         {"action_canonical", told.told_action(circle.action)},
         {"miss", json_number(circle.miss)}});
  }
  json["exit_code"] = 0;
  return json;
}

StudyReport frozen_orbit_report(const FrozenOrbitStudy& study, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"poincare.csv", frozen_orbit_csv(study)},
                  {"report.html", frozen_orbit_page(study, origin, drawer)},
                  {"summary.json", json_text(frozen_orbit_json(study)) + "\n"}};
  report.drawing_problem = drawer.problem();
  report.table = fmt::format("{}\n{}\n", study.scene.title, frozen_orbit_verdict(study));
  if (!study.circles.empty()) report.table += "\n" + aligned_table(circles_rows(study));
  add_checks(report, study.checks);
  return report;
}

}  // namespace hamjet::io
