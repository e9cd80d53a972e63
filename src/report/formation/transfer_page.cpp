#include "transfer_page.hpp"

#include <fmt/format.h>

#include "../../formats/relative_frame_text.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/html_text.hpp"
#include "../drawing/report_page.hpp"
#include "burn_view.hpp"
#include "frame_columns.hpp"
#include "fuel_view.hpp"
#include "impulse_view.hpp"
#include "thrust_view.hpp"
#include "transfer_charts.hpp"
#include "transfer_view.hpp"
#include "validity_view.hpp"
#include "waypoint_view.hpp"

namespace hamjet::io {
namespace {

std::string fitted_section(Chart chart, ChartDrawer& drawer) {
  fit(chart);
  return section_html(chart, drawer);
}

std::string state_text(const RelativeState& state, const Scene& scene) {
  const auto told = [count = told_coordinates(scene.system)](const Eigen::Vector3d& vector) {
    std::string text;
    for (const double x : along_told_axes(vector, count)) {
      text += fmt::format("{}{:g}", text.empty() ? "" : ", ", x);
    }
    return text;
  };
  return fmt::format("({}) m, ({}) m/s", told(state.position_m), told(state.velocity_m_s));
}

std::string end_text(const Scene& scene) {
  const ArrivalState& end = scene.transfer->end;
  if (end.in_form) {
    std::string text = std::string(name_of(end.in_form->form)) + ":";
    for (std::size_t i = 0; i < 6; ++i) {
      text += fmt::format("{} {} {:g}", i == 0 ? "" : ",", components_of(end.in_form->form)[i].name,
                          end.in_form->numbers[i]);
    }
    return text;
  }
  if (!end.own_state) return state_text(end, scene);
  const auto& z = *end.own_state;
  const double km = scene.units.length_km, km_s = km / scene.units.time_s;
  return fmt::format("its own orbit, ({:g}, {:g}, {:g}) km, ({:g}, {:g}, {:g}) km/s at arrival",
                     z[0] * km, z[1] * km, z[2] * km, z[3] * km_s, z[4] * km_s, z[5] * km_s);
}

std::string scene_text(const Scene& scene) {
  return fmt::format("{}, order {}", scene.name, scene.order);
}

std::string facts_html(const TransferResult& result, const ReportOrigin& origin) {
  const TransferSettings& settings = *result.scene.transfer;
  const double unit = result.scene.units.time_s;
  std::string outcomes;
  for (const TransferOutcome& outcome : transfer_outcomes(result)) {
    outcomes += fmt::format("; {} {}", outcome.count, outcome.text);
  }
  return origin_facts_html(origin) + fact_html("Scene", scene_text(result.scene)) +
         fact_html("Frame", frame_text(settings.frame) + coordinates_text(result.coordinates)) +
         fact_html("Start", state_text(settings.start, result.scene)) +
         fact_html("End", end_text(result.scene)) +
         fact_html("Transfer times", fmt::format("{}, {:.6g} s to {:.6g} s{}", result.points.size(),
                                                 settings.times.front() * unit,
                                                 settings.times.back() * unit, outcomes)) +
         fact_html("Generating function", transfer_kind_text(settings.kind, result.coordinates)) +
         fact_html("Time", fmt::format("{} for the answers, {} to prove them by flying",
                                       duration_text(result.seconds.study()),
                                       duration_text(result.seconds.proof)));
}

std::string trajectory_section(const TransferResult& result,
                               const std::optional<RelativeTrajectory>& trajectory,
                               ChartDrawer& drawer) {
  std::string html = "<section>\n<h2>Relative trajectory</h2>\n";
  const auto best = result.best_point();
  if (!trajectory || !best) {
    return html + "<p>No transfer is good enough to be drawn.</p>\n</section>\n";
  }
  html += fmt::format("<p>The transfer of the least velocity change, in {}.</p>\n",
                      time_text(result.points[*best].time * result.scene.units.time_s));
  std::vector<Chart> charts =
      relative_trajectory_charts(*trajectory, result.scene.units.time_s,
                                 result.scene.transfer->frame == RelativeFrame::coordinates
                                     ? axis_letters(result.scene.system, RelativeFrame::coordinates)
                                     : std::vector<std::string>());
  for (Chart& chart : charts) fit(chart);
  return html + panels_html(charts, drawer) + "</section>\n";
}

std::string thrust_sections(const TransferResult& result, ChartDrawer& drawer) {
  if (!result.thrust || result.thrust->profile.empty()) return thrust_section_html(result);
  return thrust_section_html(result) + fitted_section(thrust_chart(result), drawer);
}

std::string fuel_sections(const TransferResult& result, ChartDrawer& drawer) {
  if (!result.fuel || result.fuel->profile.empty()) return fuel_section_html(result);
  return fuel_section_html(result) + fitted_section(fuel_chart(result), drawer);
}

std::string impulse_sections(const TransferResult& result, ChartDrawer& drawer) {
  if (!result.primer && !result.optimal) return "";
  return impulse_table_html(result) + fitted_section(primer_chart(result), drawer);
}

}  // namespace

std::string transfer_page(const TransferResult& result,
                          const std::optional<RelativeTrajectory>& trajectory,
                          const ReportOrigin& origin, ChartDrawer& drawer) {
  ReportPage page;
  page.title = result.scene.title + ": velocity changes of transfers";
  page.verdict = transfer_verdict(result);
  Chart first = velocity_change_chart(result);
  fit(first);
  page.first_figure = figure_html(first, drawer);
  page.facts = facts_html(result, origin);
  page.sections = "<section>\n<h2>The best transfer</h2>\n" + best_transfer_table_html(result) +
                  "</section>\n" + trajectory_section(result, trajectory, drawer) +
                  impulse_sections(result, drawer) + waypoint_section_html(result) +
                  coasting_section_html(result) + revolutions_section_html(result) +
                  thrust_sections(result, drawer) + fuel_sections(result, drawer) +
                  burns_section_html(result) + fitted_section(miss_chart(result), drawer) +
                  miss_table_html(result) + fitted_section(condition_chart(result), drawer) +
                  singular_table_html(result);
  if (result.validity) {
    page.sections += fitted_section(validity_time_chart(*result.validity), drawer) +
                     validity_sections_html(*result.validity, drawer);
  }
  page.sections += "<section>\n<h2>All transfer times</h2>\n" + transfers_table_html(result) +
                   "</section>\n<section>\n<h2>What it took</h2>\n" + seconds_table_html(result) +
                   "</section>\n";
  return page_html(page, drawer);
}

std::string validity_sections_html(const ValidityResult& result, ChartDrawer& drawer) {
  std::string rows;
  for (const ValidityPoint& point : result.points) {
    for (const ValidityEntry& entry : point.entries) {
      rows += "<tr>" +
              row_name_cell(fmt::format("{:.6g}", point.time * result.scene.units.time_s)) +
              cell(std::to_string(entry.order)) + cell(length_text(entry.predicted_m)) +
              cell((entry.is_at_limit ? "at least " : "") + length_text(entry.proved_m)) +
              cell(length_text(entry.miss_m)) + "</tr>\n";
    }
  }
  return fitted_section(validity_order_chart(result), drawer) +
         table_html(
             fmt::format(
                 "The largest separation at which each order is right to the tolerance, as "
                 "predicted from the decay of the degrees and as proved by flying, and the "
                 "worst miss of the sampled deputies at the proved one. Positions fill the "
                 "ellipsoid of that separation, velocities, {}, the same times the mean motion.",
                 velocities_text(result.scene.validity->frame)),
             "<tr>" + header_cells({"time (s)", "order", "predicted", "proved", "worst miss"}) +
                 "</tr>",
             rows);
}

std::string validity_page(const ValidityResult& result, const ReportOrigin& origin,
                          ChartDrawer& drawer) {
  ReportPage page;
  page.title = result.scene.title + ": validity of the polynomials";
  page.verdict = validity_verdict(result);
  Chart first = validity_time_chart(result);
  fit(first);
  page.first_figure = figure_html(first, drawer);
  const std::string limit = reach_limit_text(result);
  page.facts = origin_facts_html(origin) + fact_html("Scene", scene_text(result.scene)) +
               fact_html("Frame", frame_text(result.scene.validity->frame) +
                                      coordinates_text(result.coordinates)) +
               fact_html("Tolerance", length_text(result.scene.validity->tolerance_m)) +
               fact_html("Flights", std::to_string(result.flights)) +
               fact_html("Flight floor", length_text(result.flight_floor_m)) +
               (limit.empty() ? "" : fact_html("Limit", limit)) +
               fact_html("Time", fmt::format("{} for the jets, {} to fly the deputies",
                                             duration_text(result.propagation_seconds),
                                             duration_text(result.proof_seconds)));
  page.sections = validity_sections_html(result, drawer);
  return page_html(page, drawer);
}

}  // namespace hamjet::io
