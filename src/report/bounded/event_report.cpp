#include "event_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include "../../formats/stored_coefficients.hpp"
#include "../../store/json_text.hpp"
#include "../../store/result_table.hpp"
#include "../../studies/bounded/scene_gauss.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "../formation/transfer_json.hpp"
#include "../study_checks.hpp"
#include "hamjet/algebra/composition.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string condition_text(const EventSettings& event) {
  const std::string way = event.direction == EventDirection::rising    ? ", rising"
                          : event.direction == EventDirection::falling ? ", falling"
                                                                       : "";
  switch (event.surface) {
    case EventSurface::equator:
      return "z = 0" + way;
    case EventSurface::plane:
      return fmt::format("({:.6g}, {:.6g}, {:.6g}) . r = {:.10g} km{}", event.normal[0],
                         event.normal[1], event.normal[2], event.offset_km, way);
    case EventSurface::distance:
      return fmt::format("|r| = {:.10g} km{}", event.distance_km, way);
    case EventSurface::expression:
      return event.expression + " = 0" + way;
    case EventSurface::apsis:
      break;
  }
  return "r . v = 0" + way;
}

/// Of six numbers or names of a state's components, those that are told.
template <class T>
std::vector<T> told_of(const EventStudy& study, const std::vector<T>& all) {
  std::vector<T> told;
  for (const std::size_t i : told_components(study.scene.system)) told.push_back(all[i]);
  return told;
}
std::vector<std::string_view> told_names(const EventStudy& study) {
  return told_of(study, variable_names(study.scene.system));
}

/// The largest amplitude up to which all misses in position are at most a metre.
std::optional<double> reach_m(const EventStudy& study) {
  std::vector<EventMisses> misses = study.misses;
  std::sort(misses.begin(), misses.end(),
            [](const auto& a, const auto& b) { return a.amplitude_m < b.amplitude_m; });
  std::optional<double> reach;
  for (const EventMisses& one : misses) {
    if (!one.position_m || *one.position_m > 1) break;
    reach = one.amplitude_m;
  }
  return reach;
}

std::vector<std::vector<std::string>> miss_rows(const EventStudy& study) {
  const int order = study.scene.order;
  std::vector<std::vector<std::string>> rows = {
      {"deviation", fmt::format("miss, order {} (m)", order), "in time (s)", "miss, order 1 (m)",
       "in time (s)"}};
  for (const EventMisses& one : study.misses) {
    std::vector<std::string>& row = rows.emplace_back(1, length_text(one.amplitude_m));
    for (const auto& miss :
         {one.position_m, one.time_s, one.linear_position_m, one.linear_time_s}) {
      row.push_back(miss ? fmt::format("{:.3g}", *miss) : "not flown");
    }
  }
  return rows;
}

Chart miss_chart(const EventStudy& study) {
  Chart chart;
  chart.name = "event-misses";
  chart.title = "Misses of flown deputies";
  chart.reading = fmt::format(
      "How far {} deputies of each deviation, flown with the full equations to the time that the "
      "polynomials give, are from where these have them; the largest. The rule is what rounding "
      "makes of a flown position.",
      study.flown);
  chart.x = logarithmic_axis("deviation in position (m)");
  chart.y = logarithmic_axis("miss in position (m)");
  const auto add = [&](const std::string& title, std::optional<double> EventMisses::*miss,
                       std::size_t style) {
    ChartCurve curve;
    curve.title = title;
    curve.style = style;
    for (const EventMisses& one : study.misses) {
      if (one.*miss) curve.points.emplace_back(one.amplitude_m, *(one.*miss));
    }
    std::sort(curve.points.begin(), curve.points.end());
    chart.curves.push_back(std::move(curve));
  };
  add(fmt::format("order {}", study.scene.order), &EventMisses::position_m, 0);
  if (study.scene.order > 1) add("order 1", &EventMisses::linear_position_m, 1);
  chart.rules.push_back({false, study.position_rounding_m, "rounding", false});
  fit(chart);
  return chart;
}

std::string event_page(const EventStudy& study, const ReportOrigin& origin, ChartDrawer& drawer) {
  ReportPage page;
  page.title = study.scene.title + ": event";
  page.verdict = event_verdict(study);
  page.first_figure = figure_html(miss_chart(study), drawer);
  page.facts =
      origin_facts_html(origin) +
      fact_html("Scene", fmt::format("{}, order {}", study.scene.name, study.scene.order)) +
      fact_html("Condition", condition_text(*study.scene.event)) +
      fact_html("Time", fmt::format("{:.12g} s", study.time_s())) +
      fact_html("Rounding", length_text(study.position_rounding_m));
  page.sections =
      "<section>\n<h2>Misses</h2>\n" +
      table_html("Of flown deputies, by the size of their deviation.", miss_rows(study)) +
      "</section>\n";
  return page_html(page, drawer);
}

/// Where the chief meets the event: its position, or all variables of a system of the scene's own.
std::string place_text(const EventStudy& study) {
  const std::vector<double> state = told_of(study, study.state());
  if (is_orbit(study.scene.system.model)) {
    const double kilometres = study.scene.units.length_km;
    return fmt::format("({:.9g}, {:.9g}, {:.9g}) km", state[0] * kilometres, state[1] * kilometres,
                       state[2] * kilometres);
  }
  const std::vector<std::string_view> names = told_names(study);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < names.size(); ++i) {
    values.push_back(fmt::format("{} = {:.9g}", names[i], state[i]));
  }
  return fmt::format("{}", fmt::join(values, ", "));
}

}  // namespace

std::string event_verdict(const EventStudy& study) {
  const std::optional<double> reach = reach_m(study);
  return fmt::format(
      "The chief meets {} (event {}) after {:.12g} s, at {}. Time and state are polynomials of "
      "order {} in the initial state; {}.",
      condition_text(*study.scene.event), study.scene.event->number, study.time_s(),
      place_text(study), study.scene.order,
      reach ? fmt::format("deputies flown with the full equations are within 1 m of them up to "
                          "deviations of {} at least",
                          length_text(*reach))
            : "no deputy that was flown is within 1 m of them");
}

FlowJet<double> told_polynomials(const EventStudy& study) {
  const SystemSettings& system = study.scene.system;
  const EventMap<double> map = study.told_map();
  FlowJet<double> told = {in_told_variables(map.time, system)};
  for (const std::size_t i : told_components(system)) {
    told.push_back(in_told_variables(map.state[i], system));
  }
  return told;
}

std::vector<TableView> event_tables(const EventStudy& study) {
  ResultTable<EventMisses> table(
      "event", "", {"misses"},
      "When and where the chief meets a condition, and how far flown deputies are from the "
      "polynomials of time and state: the largest of several with deviations of one size.");
  table.add_scalar("verdict", "", "the outcome in words", event_verdict(study));
  table.add_scalar("condition", "", "the condition in words", condition_text(*study.scene.event));
  table.add_scalar("number", "", "the number of the event among those of the chief, from 1",
                   study.scene.event->number);
  table.add_scalar("time_s", "s", "the time of the chief's event, since the start", study.time_s());
  table.add_scalar("time_canonical", "", "the same time, in the scene's canonical unit of time",
                   told_time(study.scene, study.map.time[0]));
  table.add_scalars("state_canonical", "", "the state of the chief at the event, canonical",
                    told_of(study, told_state(study.scene, study.state())));
  table.add_scalar("position_rounding_m", "m",
                   "the rounding of a flown position: misses below it say nothing",
                   study.position_rounding_m);
  table.add_scalar("flown_deputies", "", "the number of flown deputies of each deviation",
                   study.flown);
  table.add("amplitude_m", "m", "the deviation of the initial position", &EventMisses::amplitude_m);
  table.add("position_miss_m", "m",
            "the miss of the polynomials' position; nothing where a deputy could not be flown",
            &EventMisses::position_m);
  table.add("time_miss_s", "s", "the miss of the polynomials' time from that of the flown event",
            &EventMisses::time_s);
  table.add("linear_position_miss_m", "m", "the miss of the linear polynomials' position",
            &EventMisses::linear_position_m);
  table.add("linear_time_miss_s", "s", "the miss of the linear polynomials' time",
            &EventMisses::linear_time_s);
  return {std::move(table).view(study.misses, {study.misses.size()})};
}

std::string event_map_csv(const EventStudy& study) {
  const std::vector<std::string_view> names = told_names(study);
  std::vector<std::string_view> series = {"time"};
  series.insert(series.end(), names.begin(), names.end());
  const FlowJet<double> map = told_polynomials(study);
  std::vector<std::size_t> places(names.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return series_csv(series, names, places, Precision::double_precision, convert_map<Extended>(map));
}

Json event_json(const EventStudy& study) {
  Json json = study_head_json(study.scene, "event", scene_gauss_label(study.scene));
  json.update(table_json(event_tables(study).front()));
  json["exit_code"] = 0;
  return json;
}

StudyReport event_report(const EventStudy& study, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"event.csv", table_csv(event_tables(study).front())},
                  {"event-map.csv", event_map_csv(study)},
                  {"report.html", event_page(study, origin, drawer)},
                  {"summary.json", json_text(event_json(study)) + "\n"}};
  report.drawing_problem = drawer.problem();
  report.table = fmt::format("{}\n{}\n\n", study.scene.title, event_verdict(study)) +
                 aligned_table(miss_rows(study));
  add_checks(report, study.checks);
  return report;
}

}  // namespace hamjet::io
