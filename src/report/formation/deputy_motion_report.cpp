#include "deputy_motion_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/nominal/nominal_period.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../../text/time_axis.hpp"
#include "../drawing/report_page.hpp"
#include "../study_checks.hpp"
#include "drift_view.hpp"
#include "frame_columns.hpp"
#include "transfer_charts.hpp"
#include "transfer_json.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;
using MotionPoint = const DeputyMotionPoint&;

/// A larger error than this share of the separation at the time is no answer.
constexpr double resolved_share = 0.01;

/// The number of rows of the terminal's table besides the start: about eight, such that two rows
/// that follow each other are at different places of the revolution.
std::size_t shown_times(const DeputyMotion& motion) {
  constexpr std::size_t usual = 8;
  const std::optional<double> period = nominal_period(motion.scene);
  if (!period || !(*period > 0)) return usual;
  const double revolutions = std::abs(motion.points.back().time) / *period;
  std::size_t best = usual;
  double most = 0;
  for (const std::size_t count : {usual, usual - 1, usual + 1, usual + 2, usual + 3}) {
    const double turned = revolutions / static_cast<double>(count);
    // Many rows in a revolution follow its shape.
    constexpr double few = 0.3;
    if (turned <= few) return count;
    // Half a revolution later the along-track motion is at its other end again and again.
    const double from_half = std::abs(2 * turned - std::round(2 * turned));
    if (from_half > most) best = count;
    most = std::max(most, from_half);
  }
  return best;
}

std::string error_text(const DeputyMotion& motion, double error_m) {
  return miss_text(error_m, motion.flight_floor_m);
}

bool is_resolved(const DeputyMotion& motion) {
  for (std::size_t i = 1; i < motion.points.size(); ++i) {
    const double most = std::max(resolved_share * separation_m(motion.points[i].state),
                                 motion.points[i].flight_floor_m);
    if (!(motion.points[i].errors_m.back() <= most)) return false;
  }
  return true;
}

std::string terminal_table(const DeputyMotion& motion) {
  const TimeAxis axis = time_axis(seconds_at(motion, motion.points.size() - 1));
  const auto letters = axis_letters(motion.scene.deputy->frame);
  std::vector<std::vector<std::string>> rows = {{fmt::format("time ({})", axis.name)}};
  for (const std::string_view letter : letters) rows[0].push_back(fmt::format("{} (m)", letter));
  rows[0].emplace_back("separation");
  rows[0].emplace_back("error");
  rows[0].emplace_back("linear error");
  const std::size_t last = motion.points.size() - 1;
  const std::size_t count = shown_times(motion);
  for (std::size_t k = 0; k <= count; ++k) {
    const std::size_t i = k * last / count;
    const DeputyMotionPoint& point = motion.points[i];
    rows.push_back({fmt::format("{:.4g}", seconds_at(motion, i) / axis.seconds)});
    for (const double x : point.state.position_m) rows.back().push_back(fmt::format("{:.1f}", x));
    rows.back().push_back(length_text(separation_m(motion.points[i].state)));
    const auto error = [&](double error_m) {
      return i == 0 ? std::string("0 m")
             : error_m < point.flight_floor_m
                 ? fmt::format("<{}", length_text(point.flight_floor_m))
                 : length_text(error_m);
    };
    rows.back().push_back(error(point.errors_m.back()));
    rows.back().push_back(error(point.errors_m.front()));
  }
  const std::string elements = elements_text(motion.drift);
  return fmt::format("{}\n{}\nat the start: velocity {} m/s{}\nframe {}; order {}\n\n{}",
                     motion.scene.title, deputy_motion_verdict(motion),
                     vector_text(motion.points.front().state.velocity_m_s, 4),
                     elements.empty() ? "" : "; relative elements " + elements,
                     frame_text(motion.scene.deputy->frame) + coordinates_text(motion.coordinates),
                     motion.scene.order, aligned_table(rows));
}

std::string page(const DeputyMotion& motion, const ReportOrigin& origin, ChartDrawer& drawer) {
  ReportPage page;
  page.title = motion.scene.title + ": motion of the deputy";
  page.verdict = deputy_motion_verdict(motion);
  std::vector<Chart> paths = relative_trajectory_charts(motion.flown, motion.scene.units.time_s);
  for (Chart& chart : paths) fit(chart);
  Chart along_time = deputy_motion_chart(motion);
  fit(along_time);
  page.first_figure = figure_html(along_time, drawer);
  Chart errors = deputy_motion_error_chart(motion);
  fit(errors);
  page.facts =
      origin_facts_html(origin) +
      fact_html("Scene", fmt::format("{}, order {}", motion.scene.name, motion.scene.order)) +
      fact_html("Frame",
                frame_text(motion.scene.deputy->frame) + coordinates_text(motion.coordinates)) +
      fact_html("Relative velocity",
                vector_text(motion.points.front().state.velocity_m_s, 4) + " m/s at the start") +
      fact_html("Relative elements (m)", elements_text(motion.drift)) +
      fact_html("Times", std::to_string(motion.points.size())) +
      fact_html("Flight floor", length_text(motion.flight_floor_m)) +
      fact_html("Time", duration_text(motion.propagation_seconds) + " for the jets");
  page.sections = "<section>\n<h2>Relative trajectory</h2>\n" + panels_html(paths, drawer) +
                  "</section>\n" + "<section>\n<h2>" + errors.title + "</h2>\n" +
                  figure_html(errors, drawer) + "</section>\n";
  return page_html(page, drawer);
}

Json state_json(const DeputyMotion& motion, double time, const RelativeState& state) {
  return {{"time_s", time * motion.scene.units.time_s},
          {"separation_m", json_number(separation_m(state))},
          {"position_m", vector_json(state.position_m)},
          {"velocity_m_s", vector_json(state.velocity_m_s)}};
}

}  // namespace

std::string deputy_motion_verdict(const DeputyMotion& motion) {
  const auto& [nearest, farthest] = motion.extremes;
  const std::size_t last = motion.points.size() - 1;
  const TimeAxis axis = time_axis(seconds_at(motion, last));
  const auto time = [&](double canonical) {
    return fmt::format("{:.3g} {}", canonical * motion.scene.units.time_s / axis.seconds,
                       axis.name);
  };
  const auto place = [](const SeparationAt& at) { return length_text(separation_m(at.state)); };
  const int order = motion.scene.order;
  const std::string error = error_text(motion, motion.largest_error_m(order));
  std::string text = fmt::format(
      "Within {} the deputy is nearest to its chief after {}, {} away, and farthest after {}, {} "
      "away; at the end it is {} away. ",
      time(motion.points[last].time), time(nearest.time), place(nearest), time(farthest.time),
      place(farthest), length_text(separation_m(motion.points[last].state)));
  const std::string drift = drift_text(motion.scene, motion.drift, motion.points.front().state,
                                       motion.scene.deputy->frame);
  if (!drift.empty()) text += drift + " ";
  if (motion.manoeuvres > 0) {
    text += fmt::format("{} of the orbit messages {} flown; behind each, polynomials begin anew. ",
                        counted(static_cast<std::size_t>(motion.manoeuvres), "manoeuvre"),
                        motion.manoeuvres == 1 ? "is" : "are");
  }
  text += fmt::format("Polynomials of order {} are never wrong by {}{}", order,
                      error.starts_with("less") ? "as much as " : "more than ",
                      error.starts_with("less") ? length_text(motion.flight_floor_m) : error);
  if (order > 1) {
    text += fmt::format(", the linear theory by up to {}", length_text(motion.largest_error_m(1)));
  }
  text += ", measured by flying both with the full equations of motion.";
  if (!is_resolved(motion)) {
    text += fmt::format(
        " At some time that is more than a hundredth of the separation: the deputy is beyond what "
        "order {} resolves there. {}; `hamjet validity` says how far apart the two may be.",
        order,
        motion.coordinates.start == JetCoordinates::cartesian
            ? "jet.coordinates = \"flow-box\" reach tens of times further, a higher jet.order or a "
              "shorter duration somewhat"
            : "A higher jet.order or a shorter duration reaches it");
  }
  return text;
}

Json deputy_motion_json(const DeputyMotion& motion) {
  Json json = study_head_json(motion.scene, "motion", motion.integrator);
  const TableView table = deputy_motion_table(motion);
  json.update(table_json(table));
  add_chosen_by(json, motion.coordinates);
  const auto& [nearest, farthest] = motion.extremes;
  json["start"] = row_json(table, 0);
  add_drift(json["start"], motion.drift, motion.points.front().state);
  json["end"] = row_json(table, motion.points.size() - 1);
  json["nearest"] = state_json(motion, nearest.time, nearest.state);
  json["farthest"] = state_json(motion, farthest.time, farthest.state);
  json["seconds"] = {{"propagation", motion.propagation_seconds}};
  return json;
}

TableView deputy_motion_table(const DeputyMotion& motion) {
  const double unit = motion.scene.units.time_s;
  const RelativeFrame frame = motion.scene.deputy->frame;
  std::vector<std::string> places, velocities, errors;
  for (const std::string_view letter : axis_letters(frame)) {
    places.push_back(fmt::format("{}_m", letter));
    velocities.push_back(fmt::format("v{}_m_s", letter));
  }
  std::vector<double> largest_errors_m;
  for (int order = 1; order <= motion.scene.order; ++order) {
    errors.push_back(fmt::format("error_m_order_{}", order));
    largest_errors_m.push_back(motion.largest_error_m(order));
  }
  ResultTable<DeputyMotionPoint> table("motion", "", {"times"},
                                       "Where the deputy is beside its chief, as it flew.");
  table.leave_rows_out_of_json();
  table.add("time_canonical", "", "since the start, in the scene's canonical unit of time",
            [&](MotionPoint point) { return told_time(motion.scene, point.time); });
  table.add("time_s", "s", "since the start", [=](MotionPoint point) { return point.time * unit; });
  table.add_array("position_m", places, "m", "relative to the chief, along the frame's axes",
                  [](MotionPoint point) { return point.state.position_m; });
  table.add_array("velocity_m_s", velocities, "m/s",
                  "velocity relative to the chief, along the frame's axes",
                  [](MotionPoint point) { return point.state.velocity_m_s; });
  table.add("separation_m", "m", "the distance between chief and deputy",
            [](MotionPoint point) { return separation_m(point.state); });
  table.add_array(
      "error_m_by_order", errors, "m",
      "the distance of the flown deputy from where the polynomials of the orders 1 to N have it",
      &DeputyMotionPoint::errors_m);
  add_frame(table, motion.scene.system, frame, motion.coordinates);
  table.add_scalar("verdict", "",
                   "how near and how far the deputy comes, and how wrong the polynomials are",
                   deputy_motion_verdict(motion));
  table.add_scalar("duration_s", "s", "the duration of the motion",
                   motion.points.back().time * unit);
  table.add_scalar("times", "", "the number of times", motion.points.size());
  table.add_scalar("largest_error_m", "m", "the largest error of the highest order",
                   largest_errors_m.back());
  table.add_scalars("largest_error_m_by_order", "m",
                    "the largest errors over all times, of the orders 1 to N", largest_errors_m);
  table.add_scalar("is_resolved", "",
                   "whether the highest order is right to a hundredth of the separation",
                   is_resolved(motion));
  table.add_scalar("flight_floor_m", "m", "errors below this say nothing", motion.flight_floor_m);
  table.add_scalar("manoeuvres", "",
                   "the number of manoeuvres of the orbit messages that are flown",
                   motion.manoeuvres);
  table.add_scalar("exit_code", "", "the exit code of the command", 0);
  TableView view = std::move(table).view(motion.points, {motion.points.size()});
  view.places_of_rows = {{0, "/start"}, {motion.points.size() - 1, "/end"}};
  return view;
}

StudyReport deputy_motion_report(const DeputyMotion& motion, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"motion.csv", table_csv(deputy_motion_table(motion))},
                  {"report.html", page(motion, origin, drawer)}};
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(deputy_motion_json(motion)) + "\n"});
  report.table = terminal_table(motion);
  report.details =
      fmt::format("{}; {} for the jets (flight floor {})\n", counted(motion.points.size(), "time"),
                  duration_text(motion.propagation_seconds), length_text(motion.flight_floor_m));
  add_checks(report, motion.checks);
  return report;
}

}  // namespace hamjet::io
