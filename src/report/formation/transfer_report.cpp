#include <fmt/format.h>

#include "../../formats/orbit_messages/orbit_ephemeris.hpp"
#include "../../formats/output_formats.hpp"
#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/html_text.hpp"
#include "../drawing/chart_drawer.hpp"
#include "../drawing/study_figure.hpp"
#include "../own_units_text.hpp"
#include "../study_checks.hpp"
#include "burn_view.hpp"
#include "feedback_errors_view.hpp"
#include "fuel_view.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "impulse_tables.hpp"
#include "impulse_view.hpp"
#include "thrust_view.hpp"
#include "transfer_charts.hpp"
#include "transfer_json.hpp"
#include "transfer_page.hpp"
#include "transfer_tables.hpp"
#include "transfer_view.hpp"
#include "validity_table.hpp"
#include "validity_view.hpp"
#include "waypoint_view.hpp"

namespace hamjet::io {
namespace {

std::string change_line(const TransferResult& result, const char* name,
                        std::optional<std::size_t> index) {
  if (!index) return fmt::format("  {:<17}none\n", name);
  const TransferPoint& point = result.points[*index];
  const TransferAnswer& answer = *shown_answer(point);
  return fmt::format("  {:<17}{} in {}, {}, {}: misses by {}\n", name,
                     velocity_text(answer.total_change_m_s()),
                     time_text(point.time * result.scene.units.time_s),
                     point.kind ? told_kind(*point.kind, result.scene.system) : "no kind",
                     answer_name(point), miss_text(answer.miss_m, result.flight_floor_m));
}

std::string singular_line(const TransferResult& result) {
  constexpr std::size_t most_shown = 12;
  const std::vector<SingularTime> times = result.position_singularities();
  if (times.empty()) return "  F1 singular      at no time of the span\n";
  std::string text = "  F1 singular      at";
  for (std::size_t i = 0; i < times.size() && i < most_shown; ++i) {
    text += i == 0 ? " " : ", ";
    text += singular_time_text(times[i], result.scene.units.time_s, 4);
  }
  text += times.size() > most_shown ? fmt::format(" and {} more", times.size() - most_shown) : "";
  return text + " s\n";
}

std::string terminal_table(const TransferResult& result) {
  const TransferSettings& settings = *result.scene.transfer;
  const TransferCounts counts = count_points(result);
  const double unit = result.scene.units.time_s;
  std::string text = fmt::format(
      "{}\n{}\n"
      "  frame            {}; order {}, kind {}\n"
      "  transfer times   {}, {:.6g} s to {:.6g} s:\n",
      result.scene.title, transfer_verdict(result),
      frame_text(settings.frame) + coordinates_text(result.coordinates), result.scene.order,
      transfer_kind_text(settings.kind, result.coordinates), counts.times,
      settings.times.front() * unit, settings.times.back() * unit);
  if (const std::string units = own_units_text(result.scene); !units.empty()) {
    text.insert(text.find("  transfer times"), fmt::format("  {:<17}{}\n", "units", units));
  }
  for (const TransferOutcome& outcome : transfer_outcomes(result)) {
    text += fmt::format("{:19}{} {}\n", "", outcome.count, outcome.text);
  }
  text += change_line(result, "least", result.best_point()) +
          change_line(result, "greatest", costliest_point(result));
  text += impulse_lines(result) + waypoint_lines(result) + coasting_lines(result) +
          revolutions_lines(result) + thrust_lines(result) + fuel_lines(result) +
          burn_lines(result);
  const std::vector<MissStatistics> misses = miss_statistics(result);
  if (!misses.empty()) {
    text += "  misses           away from singularities, the median and the largest:\n";
  }
  for (const MissStatistics& entry : misses) {
    text += fmt::format("  {:<17}{}, {}\n", entry.answer,
                        miss_text(entry.median_m, result.flight_floor_m),
                        miss_text(entry.largest_m, result.flight_floor_m));
  }
  text += singular_line(result);
  if (result.chief_error_m > settings.tolerance_m) {
    text += fmt::format(
        "  chief            the integrator's chief is {} from the flown one at the last time: too "
        "inaccurate for the tolerance\n",
        length_text(result.chief_error_m));
  }
  if (counts.refinement_failed > 0) {
    text += fmt::format("  not refined      {}; see transfers.csv\n",
                        counted(counts.refinement_failed, "time"));
  }
  return text;
}

/// How the answers were checked, and what that took.
std::string terminal_details(const TransferResult& result) {
  std::string text;
  if (const std::string residual = hamilton_jacobi_text(result); !residual.empty()) {
    text += fmt::format("  Hamilton-Jacobi  residual {}\n", residual);
  }
  return text + fmt::format(
                    "  time             {} for the answers, {} to prove them by flying "
                    "(floor {}), {} for the Hamilton-Jacobi residuals\n",
                    duration_text(result.seconds.study()), duration_text(result.seconds.proof),
                    length_text(result.flight_floor_m), duration_text(result.seconds.residual));
}

}  // namespace

StudyReport transfer_report(const TransferResult& result,
                            const std::optional<RelativeTrajectory>& trajectory,
                            const ReportOrigin& origin) {
  StudyReport report;
  report.files = {{"transfers.csv", table_csv(transfers_table(result))},
                  {"singular_times.csv", table_csv(singular_times_table(result))},
                  {"conditions.csv", table_csv(conditions_table(result))}};
  if (result.optimal)
    report.files.push_back({"impulses.csv", table_csv(optimal_impulses_table(result))});
  if (result.waypoints)
    report.files.push_back({"waypoints.csv", table_csv(waypoint_impulses_table(result))});
  if (result.thrust)
    report.files.push_back({"energy_optimal.csv", table_csv(energy_optimal_table(result))});
  if (result.thrust)
    report.files.push_back({"thrust_profile.csv", table_csv(thrust_profile_table(result))});
  if (result.thrust && result.thrust->feedback) {
    report.files.push_back({"feedback.csv", table_csv(feedback_table(result))});
    report.files.push_back({"feedback.json", json_text(feedback_json(result)) + "\n"});
    if (result.thrust->feedback->failure.empty()) {
      report.files.push_back({"feedback.c", feedback_c_text(result)});
    }
    if (result.scene.transfer->errors) {
      report.files.push_back({"feedback_errors.csv", table_csv(feedback_errors_table(result))});
      report.files.push_back({"feedback_samples.csv", table_csv(feedback_samples_table(result))});
    }
  }
  if (result.fuel) {
    report.files.push_back({"fuel_optimal.csv", table_csv(fuel_optimal_table(result))});
    report.files.push_back({"fuel_optimal_burns.csv", table_csv(fuel_optimal_burns_table(result))});
    report.files.push_back({"primer_profile.csv", table_csv(primer_profile_table(result))});
  }
  if (result.burns) report.files.push_back({"burns.csv", table_csv(burns_table(result))});
  if (result.validity)
    report.files.push_back({"validity.csv", table_csv(validity_table(*result.validity))});
  const OutputSettings& output = result.scene.output;
  const bool has_messages = output.has(oem_format.name) || output.has(oem_xml_format.name);
  if (has_messages && trajectory) {
    for (ReportFile& file : transfer_oems(result, *trajectory)) {
      report.files.push_back(std::move(file));
    }
  }
  const bool has_opms = output.has(start_opm_format.name) || output.has(start_opm_xml_format.name);
  if (has_opms && result.best_point()) {
    for (ReportFile& file : transfer_opms(result)) report.files.push_back(std::move(file));
  }
  ChartDrawer drawer(origin.gnuplot);
  report.files.push_back({"report.html", transfer_page(result, trajectory, origin, drawer)});
  report.drawing_problem = drawer.problem();
  if (trajectory && !report.drawing_problem) {
    std::vector<std::string> axes;
    if (result.scene.transfer->frame == RelativeFrame::coordinates) {
      axes = axis_letters(result.scene.system, RelativeFrame::coordinates);
    }
    // One coordinate has no plane.
    const Chart figure =
        axes.size() == 1
            ? relative_trajectory_charts(*trajectory, result.scene.units.time_s, axes).front()
            : rendezvous_chart(*trajectory, axes);
    add_figure(report, {figure}, origin.gnuplot);
  }
  report.exit_code = exit_code(result);
  report.failure = transfer_failure(result);
  nlohmann::ordered_json summary = transfer_summary_json(result);
  summary["validity"] =
      result.validity ? validity_json(*result.validity) : nlohmann::ordered_json(nullptr);
  summary["exit_code"] = report.exit_code;
  report.files.push_back({"summary.json", json_text(summary) + "\n"});
  report.table = terminal_table(result);
  report.details = terminal_details(result);
  if (result.validity) {
    report.table += "  validity         " + validity_verdict(*result.validity) + "\n";
  }
  add_checks(report, result.checks);
  return report;
}

StudyReport flown_transfer_report(const TransferResult& result, const ReportOrigin& origin) {
  std::optional<RelativeTrajectory> trajectory;
  if (const auto best = result.best_point()) trajectory = fly_relative(result, *best);
  return transfer_report(result, trajectory, origin);
}

}  // namespace hamjet::io
