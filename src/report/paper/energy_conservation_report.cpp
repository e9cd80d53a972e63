#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "../../scene/systems/system_json.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../drawing/study_figure.hpp"
#include "energy_conservation_charts.hpp"
#include "hamjet/version.hpp"
#include "paper_reports.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// A number, or null if it was not computed or is not finite.
Json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::string_view method_name(const EnergyConservationStudy& study) {
  return energy_conserving_method_names()[static_cast<std::size_t>(study.method)];
}

/// Names of the causes of a stop in the summary, in the order of the enumeration.
const char* cause_name(EnergyConservingStopCause cause) {
  constexpr const char* names[] = {"no-root",           "reversed-root", "step-change",
                                   "undetermined-step", "no-midpoint",   "not-finite"};
  return names[static_cast<std::size_t>(cause)];
}

/// A number for CSV; empty if it is not finite.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}
std::string number(const std::optional<double>& value) { return value ? number(*value) : ""; }

std::string trajectory_csv(const EnergyConservationResult& result) {
  const EnergyConservationStudy& study = result.study;
  const double time_s = study.units.time_s;
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "step,time_canonical,time_s,step_size_canonical,step_size_s");
  for (const auto name : variable_names(study.system)) fmt::format_to(write, ",{}", name);
  fmt::format_to(write, ",discrete_energy_error,energy_error,condition,newton_iterations\n");
  for (const EnergyConservationPoint& point : result.points) {
    const std::optional<double> size_s =
        point.size ? std::optional<double>(*point.size * time_s) : std::nullopt;
    fmt::format_to(write, "{},{},{},{},{}", point.step, number(point.time),
                   number(point.time * time_s), number(point.size), number(size_s));
    for (const double x : point.state) fmt::format_to(write, ",{}", number(x));
    fmt::format_to(write, ",{},{},{},{}\n", number(point.discrete), number(point.energy_error),
                   number(point.condition), point.newton_iterations);
  }
  return fmt::to_string(out);
}

std::string fixed_step_csv(const EnergyConservationResult& result) {
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "time_canonical,time_s,energy_error\n");
  for (const auto& [time, error] : result.fixed_step.energy_errors) {
    fmt::format_to(write, "{},{},{}\n", number(time), number(time * result.study.units.time_s),
                   number(error));
  }
  return fmt::to_string(out);
}

Json stop_json(const EnergyConservationResult& result) {
  if (!result.run.stop) return nullptr;
  const EnergyConservingStop& stop = *result.run.stop;
  return {{"step", stop.step},
          {"time_canonical", stop.time},
          {"time_s", stop.time * result.study.units.time_s},
          {"cause", cause_name(stop.cause)},
          {"condition", number_or_null(stop.condition)},
          {"steps_to_sign_change", number_or_null(stop.steps_to_sign_change)},
          {"predicted_time_canonical", number_or_null(result.predicted_time)},
          {"message", stop.message}};
}

Json fixed_step_json(const FixedStepTrajectory& fixed) {
  return {{"method", fixed.method},
          {"step_canonical", fixed.step},
          {"steps", fixed.steps},
          {"time_canonical", fixed.energy_errors.back().first},
          {"largest_energy_error", number_or_null(fixed.largest_energy_error)},
          {"error", text_or_null(fixed.failure)}};
}

std::string summary_json(const EnergyConservationResult& result) {
  const EnergyConservationStudy& study = result.study;
  const bool has_steps = result.run.steps > 0;
  const auto if_stepped = [has_steps](double value) {
    return has_steps ? number_or_null(value) : Json(nullptr);
  };
  const Json json = {
      {"scene", study.name},
      {"title", study.title},
      {"version", version},
      {"study", "energy-conservation"},
      {"model", model_name(study.system.model)},
      {"units", units_json(study.units)},
      {"method", method_name(study)},
      {"first_step_canonical", study.first_step},
      {"duration_canonical", study.duration},
      {"nominal_initial", study.nominal},
      {"conserved_energy", if_stepped(result.run.energy)},
      {"steps", result.run.steps},
      {"time_canonical", result.run.time},
      {"state_final", result.run.state},
      {"largest_discrete_energy_error", if_stepped(result.largest_discrete_error)},
      {"largest_energy_error", if_stepped(result.largest_energy_error)},
      {"smallest_step_canonical", if_stepped(result.smallest_step)},
      {"largest_step_canonical", if_stepped(result.largest_step)},
      {"newton_iterations", result.run.newton_iterations},
      {"expect", energy_conservation_outcome_names()[static_cast<std::size_t>(study.expected)]},
      {"stop", stop_json(result)},
      {"fixed_step", fixed_step_json(result.fixed_step)},
      {"failed_checks", result.failed_checks},
      {"exit_code", result.exit_code()}};
  return json_text(json) + "\n";
}

std::string table(const EnergyConservationResult& result) {
  const EnergyConservationStudy& study = result.study;
  const EnergyConservingResult<double>& run = result.run;
  const FixedStepTrajectory& fixed = result.fixed_step;
  std::string text = fmt::format(
      "{}: energy-conserving {}, first step {:.6g} canonical\n"
      "  trajectory        {} steps to t = {:.8g} of {:.8g} canonical, {} Newton iterations\n",
      study.title, method_name(study), study.first_step, run.steps, run.time, study.duration,
      run.newton_iterations);
  if (run.steps > 0) {
    text += fmt::format(
        "  step size         {:.4g} to {:.4g} canonical\n"
        "  discrete energy   E = {:.10g}, largest error {:.1e} of |H(z_0)|\n"
        "  H at the points   largest error {:.1e}\n",
        result.smallest_step, result.largest_step, run.energy, result.largest_discrete_error,
        result.largest_energy_error);
  }
  text += fmt::format("  {:<17} {} steps of {:.4g} to t = {:.8g}, largest error {:.1e}\n",
                      fixed.method, fixed.steps, fixed.step, fixed.energy_errors.back().first,
                      fixed.largest_energy_error);
  if (!fixed.failure.empty()) text += fmt::format("                    {}\n", fixed.failure);
  if (run.stop) {
    text += fmt::format("  stopped           {}\n", run.stop->message);
    if (result.predicted_time) {
      text += fmt::format(
          "  predicted         t = {:.10g} for small steps, where the condition changes sign on "
          "the "
          "exact flow; observed t = {:.10g}, {:+.3g} last steps from it\n",
          *result.predicted_time, run.stop->time,
          (run.stop->time - *result.predicted_time) / run.last_step);
    } else if (run.steps == 0) {
      text += "  predicted         not computed, for no step was taken\n";
    } else {
      text +=
          "  predicted         nothing: on the exact flow the condition does not change sign near "
          "here; steps this large mislead the line, and smaller ones may pass\n";
    }
  }
  return text;
}

}  // namespace

template <>
StudyReport study_report(const EnergyConservationResult& result, Figure figure) {
  StudyReport report;
  report.files = {{"trajectory.csv", trajectory_csv(result)},
                  {"fixed_step.csv", fixed_step_csv(result)}};
  if (figure == Figure::drawn) add_figure(report, energy_conservation_charts(result));
  report.table = table(result);
  report.exit_code = result.exit_code();
  report.failure = result.failure();
  report.files.push_back({"summary.json", summary_json(result)});
  return report;
}

}  // namespace hamjet::io
