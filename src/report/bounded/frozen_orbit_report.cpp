#include "frozen_orbit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "../../store/json_text.hpp"
#include "../../store/result_table.hpp"
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

namespace {

/// What is told of the frozen orbit itself.
TableView frozen_orbit_table(const FrozenOrbitStudy& study) {
  ResultTable<std::monostate> table(
      "frozen_orbit", "/frozen_orbit", {},
      "The frozen orbit, osculating on the chief's mean argument of latitude.");
  const CanonicalUnits& units = study.scene.units;
  table.add_scalars(
      "state_canonical", "",
      "the state of the frozen orbit at the section, with the chief's node, canonical",
      told_state(study.scene, study.state));
  table.add_scalar("a_km", "km", "the semi-major axis of the frozen orbit",
                   study.semi_major_axis * units.length_km);
  table.add_scalar("e", "", "the eccentricity of the frozen orbit", study.eccentricity);
  table.add_scalar("i_deg", "deg", "the inclination of the frozen orbit", study.inclination_deg);
  table.add_scalar("argp_deg", "deg", "the argument of the pericentre of the frozen orbit",
                   study.pericentre_deg);
  table.add_scalar("inside_body", "",
                   "whether the pericentre of the frozen orbit lies inside the body",
                   study.is_inside_body());
  table.add_scalar("nodal_period_s", "s", "the time from section to section",
                   study.nodal_period * units.time_s);
  table.add_scalar("node_deg_per_revolution", "deg a revolution",
                   "the drift of the frozen orbit's node", study.node * degrees);
  table.add_scalar("residual", "",
                   "by how much a revolution moves the frozen orbit, in extended precision",
                   study.residual);
  table.add_scalar("iterations", "", "the number of iterations of Newton's method",
                   study.iterations);
  table.add_scalar("trace", "", "the sum of the two multipliers of the frozen orbit", study.trace);
  table.add_scalar("trace_less_2", "",
                   "the sum of the two multipliers less 2; stable between -4 and 0",
                   study.trace_less_2);
  table.add_scalars("multiplier", "", "one of the two multipliers, its real and imaginary parts",
                    study.multiplier());
  table.add_scalar("area_defect", "", "the product of the two multipliers, less 1",
                   study.area_defect);
  table.add_scalar("stable", "", "whether both multipliers are on the unit circle",
                   study.is_stable());
  return std::move(table).view(std::vector<std::monostate>(1), {});
}

/// What librates about it, by the normal form.
TableView circles_table(const FrozenOrbitStudy& study) {
  ResultTable<LibrationCircle> table(
      "poincare", "", {"circles"},
      "Circles of the normal form about the frozen orbit, at the chief's energy and momentum.");
  const auto of_form = [&](auto value) {
    return study.failure.empty() ? std::optional(value) : std::nullopt;
  };
  table.add_scalar("verdict", "", "the outcome in words", frozen_orbit_verdict(study));
  table.add_scalar("failure", "", "the reason why there is no normal form", study.failure);
  table.add_scalar("smallest_divisor", "", "the smallest divisor of the normal form",
                   of_form(study.smallest_divisor));
  table.add_scalar(
      "flown_revolutions", "",
      "the number of revolutions after which flown orbits are compared with the normal form",
      of_form(study.flown_revolutions));
  table.add_scalar("reach_m", "m",
                   "the amplitude up to which flown orbits miss by no more than `largest_miss`",
                   of_form(study.length_m(study.reach)));
  table.add_scalar("largest_miss", "",
                   "the largest miss that counts as right, in parts of the amplitude",
                   FrozenOrbitStudy::largest_miss);
  table.add("amplitude_m", "m",
            "the radius of the eccentricity vector's circle, times the semi-major axis",
            [&](const LibrationCircle& circle) { return study.length_m(circle.amplitude); });
  table.add("amplitude_eccentricity", "", "the radius of the eccentricity vector's circle",
            &LibrationCircle::amplitude);
  table.add("chief", "", "whether the scene's chief is on this circle",
            &LibrationCircle::is_chiefs);
  table.add("rotation_number", "", "the turns of the eccentricity vector a revolution",
            &LibrationCircle::rotation_number);
  table.add(
      "mean_nodal_period_s", "s", "the mean period from node to node",
      [&](const LibrationCircle& circle) { return circle.mean_period * study.scene.units.time_s; });
  table.add("node_deg_per_revolution", "deg a revolution", "the mean drift of the node",
            [](const LibrationCircle& circle) { return circle.mean_node * degrees; });
  const CanonicalFactors told = told_factors(study.scene);
  table.add("action_canonical", "", "the circle's action, canonical",
            [=](const LibrationCircle& circle) { return told.told_action(circle.action); });
  table.add("miss", "",
            "the miss of a flown orbit from the normal form, in parts of the amplitude; nothing "
            "where it could not be flown",
            &LibrationCircle::miss);
  return std::move(table).view(study.circles, {study.circles.size()});
}

}  // namespace

std::vector<TableView> poincare_tables(const FrozenOrbitStudy& study) {
  return {circles_table(study), frozen_orbit_table(study)};
}

Json frozen_orbit_json(const FrozenOrbitStudy& study) {
  Json json = study_head_json(study.scene, "poincare", scene_gauss_label(study.scene));
  json["verdict"] = frozen_orbit_verdict(study);
  json["frozen_orbit"] = table_json(frozen_orbit_table(study));
  json.update(table_json(circles_table(study)));
  json["exit_code"] = 0;
  return json;
}

StudyReport frozen_orbit_report(const FrozenOrbitStudy& study, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"poincare.csv", table_csv(circles_table(study))},
                  {"report.html", frozen_orbit_page(study, origin, drawer)},
                  {"summary.json", json_text(frozen_orbit_json(study)) + "\n"}};
  report.drawing_problem = drawer.problem();
  report.table = fmt::format("{}\n{}\n", study.scene.title, frozen_orbit_verdict(study));
  if (!study.circles.empty()) report.table += "\n" + aligned_table(circles_rows(study));
  add_checks(report, study.checks);
  return report;
}

}  // namespace hamjet::io
