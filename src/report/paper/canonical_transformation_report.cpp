#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../../scene/scene_sections.hpp"
#include "../../scene/systems/system_json.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../drawing/study_figure.hpp"
#include "canonical_transformation_charts.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "paper_reports.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string trajectory_file(const CanonicalTransformationRun& run) {
  return fmt::format("trajectory_step_{}.csv", run.requested_step);
}

/// The trajectory as CSV. The transformed variables have a prefix, for readers of CSV to which q
/// and Q are the same.
std::string trajectory_csv(const CanonicalTransformationResult& result,
                           const CanonicalTransformationRun& run) {
  const auto names = variable_names(result.study.system);
  std::string text = "step,time_canonical";
  for (const auto& name : names) text += fmt::format(",{}", name);
  for (const auto& name : names) text += fmt::format(",transformed_{}", name);
  text += ",energy_error,transformed_energy_error,difference\n";
  for (const CanonicalTransformationPoint& point : run.trajectory) {
    text += fmt::format("{},{:.17g}", point.step, point.time);
    for (const double x : point.original) text += fmt::format(",{:.17g}", x);
    for (const double x : point.transformed) text += fmt::format(",{:.17g}", x);
    text += fmt::format(",{:.17g},{:.17g},{:.17g}\n", point.energy_error,
                        point.transformed_energy_error,
                        point.transformed_energy_error - point.energy_error);
  }
  return text;
}

Json kind_json(const HamiltonJacobiCheck& check) {
  return {{"steps_where_it_exists", check.steps},
          {"largest_residual", or_null(check.largest_residual)},
          {"smallest_existence_measure", or_null(check.smallest_existence)}};
}

Json run_json(const CanonicalTransformationRun& run) {
  Json json = {{"requested_step_canonical", run.requested_step},
               {"step_canonical", run.step},
               {"steps", run.steps},
               {"error", text_or_null(run.failure)},
               {"trajectory", trajectory_file(run)},
               {"trajectory_interval_steps", run.stored_interval}};
  const bool is_empty = run.trajectory.empty();
  const auto number = [&](double value) { return is_empty ? Json(nullptr) : Json(value); };
  json["largest_energy_error"] = number(run.largest_energy_error);
  json["largest_transformed_energy_error"] = number(run.largest_transformed_energy_error);
  json["largest_energy_difference"] = number(run.largest_energy_difference);
  json["largest_state_difference"] = number(run.largest_state_difference);
  json["largest_condition"] = number(run.largest_condition);
  json["symplecticity_defect"] = number(run.largest_symplecticity_defect);
  json["crosses_barrier"] = or_null(run.crosses_barrier);
  json["hamilton_jacobi"] = {{"largest_residual", or_null(run.hamilton_jacobi_residual)},
                             {"first_kind", kind_json(run.first_kind)},
                             {"second_kind", kind_json(run.second_kind)}};
  return json;
}

Json matrix_json(const Matrix<Extended>& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(convert<double>(matrix(i, j)));
    rows.push_back(row);
  }
  return rows;
}

std::string summary_json(const CanonicalTransformationResult& result) {
  const CanonicalTransformationStudy& study = result.study;
  Json shift = Json::array();
  for (const Extended& x : study.transformation.shift()) shift.push_back(convert<double>(x));
  Json json = {{"scene", study.name},
               {"title", study.title},
               {"version", version},
               {"study", "canonical-transformation"},
               {"model", model_name(study.system.model)},
               {"units", units_json(study.units)},
               {"duration_canonical", study.duration},
               {"nominal_initial", study.nominal},
               {"energy", result.energy},
               {"matrix", matrix_json(study.transformation.matrix())},
               {"shift", shift},
               {"require_invariance", or_null(study.require_invariance)},
               {"exit_code", exit_code(result)}};
  json["runs"] = Json::array();
  for (const CanonicalTransformationRun& run : result.runs) json["runs"].push_back(run_json(run));
  return json_text(json) + "\n";
}

std::string number_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.1e}", *value) : "-";
}

std::string table(const CanonicalTransformationResult& result) {
  const CanonicalTransformationStudy& study = result.study;
  std::string text = fmt::format(
      "{}\nmidpoint scheme in z and in Z = f_k(z), f_k = f composed k times; duration {:.10g} "
      "canonical, energy {:.6g}\n\n",
      study.title, study.duration, result.energy);
  // 80 characters, which a terminal has.
  constexpr std::string_view layout = "{:>5} {:>6} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8}  {}\n";
  text += fmt::format(layout, "step", "steps", "energy", "energy", "differ.", "differ.", "Hamilton",
                      "cond.", "crosses");
  text += fmt::format(layout, "", "", "error z", "error Z", "of errors", "of states", "-Jacobi",
                      "of A_k", "barrier");
  for (const CanonicalTransformationRun& run : result.runs) {
    if (!run.trajectory.empty()) {
      const std::string barrier =
          !run.crosses_barrier ? "-" : (*run.crosses_barrier ? "yes" : "no");
      text += fmt::format(layout, fmt::format("{:g}", run.requested_step), run.steps,
                          fmt::format("{:.2e}", run.largest_energy_error),
                          fmt::format("{:.2e}", run.largest_transformed_energy_error),
                          fmt::format("{:.1e}", run.largest_energy_difference),
                          fmt::format("{:.1e}", run.largest_state_difference),
                          number_or_dash(run.hamilton_jacobi_residual),
                          fmt::format("{:.3g}", run.largest_condition), barrier);
    }
    if (!run.failure.empty()) {
      text += fmt::format("FAILED: step {:g}: {}\n", run.requested_step, run.failure);
    }
  }
  text +=
      "\nlargest magnitudes over all steps, canonical: the energy error, the difference of the "
      "energy errors in z and in Z, that of f_k^-1(Z_k) and z_k, the residual of the discrete "
      "Hamilton-Jacobi equation with the generating function of the first or second kind that is "
      "better conditioned. Round-off grows with the condition of A_k (Frobenius norm; 2 for a "
      "rotation).\n";
  return text;
}

/// The first reason for an exit code other than 0.
std::string failure(const CanonicalTransformationResult& result) {
  for (const CanonicalTransformationRun& run : result.runs) {
    if (!run.failure.empty()) {
      return fmt::format("step {:g} stopped {}", run.requested_step, run.failure);
    }
  }
  for (const CanonicalTransformationRun& run : result.runs) {
    if (result.study.require_invariance &&
        !(run.largest_energy_difference <= *result.study.require_invariance)) {
      return fmt::format(
          "a check that the scene asks for failed: with step {:g} the energy errors differ by "
          "{:.3g}, require_invariance is {:g}",
          run.requested_step, run.largest_energy_difference, *result.study.require_invariance);
    }
  }
  return "";
}

}  // namespace

template <>
StudyReport study_report(const CanonicalTransformationResult& result, Figure figure) {
  StudyReport report;
  for (const CanonicalTransformationRun& run : result.runs) {
    report.files.push_back({trajectory_file(run), trajectory_csv(result, run)});
  }
  if (figure == Figure::drawn) add_figure(report, canonical_transformation_charts(result));
  report.files.push_back({"summary.json", summary_json(result)});
  report.table = table(result);
  report.exit_code = exit_code(result);
  report.failure = failure(result);
  if (report.exit_code == static_cast<int>(ErrorKind::check_failed)) {
    report.table += fmt::format("CHECK FAILED: {}\n", report.failure);
  }
  return report;
}

}  // namespace hamjet::io
