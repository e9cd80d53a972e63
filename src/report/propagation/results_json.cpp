#include <nlohmann/json.hpp>

#include "../../formats/jet_description.hpp"
#include "../../formats/results_names.hpp"
#include "../../scene/systems/system_json.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/checks/kept_tolerance.hpp"
#include "../../studies/checks/run_warnings.hpp"
#include "../../studies/formation/charts/charted_jet.hpp"
#include "../../studies/reference.hpp"
#include "../study_checks.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/version.hpp"
#include "results_operations_json.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json exactness_json(const PropagationResult& result, const KindResult& kind) {
  Json by_degree = Json::array();
  for (const ExactnessEntry& entry : kind.by_degree) {
    Json row = {{"degree", entry.residual.degree},
                {"absolute", entry.residual.absolute},
                {"scaled", entry.residual.scaled},
                {"at_formation_scale", or_null(entry.residual.at_formation_scale)},
                {"floor", nullptr},
                {"floor_scaled", nullptr},
                {"floor_at_formation_scale", nullptr},
                {"at_floor", nullptr},
                {"forces", nullptr},
                {"forces_scaled", nullptr},
                {"integration", or_null(entry.integration)}};
    if (entry.forces) {
      row["forces"] = entry.forces->absolute;
      row["forces_scaled"] = entry.forces->scaled;
    }
    if (entry.floor) {
      row["floor"] = entry.floor->absolute;
      row["floor_scaled"] = entry.floor->scaled;
      row["floor_at_formation_scale"] = or_null(entry.floor->at_formation_scale);
      row["at_floor"] = is_at_floor(entry);
    }
    by_degree.push_back(row);
  }
  return {{"kind", kind_name(kind)},
          {"requested", kind.requested},
          {"variables", generating_function_variables(result, kind.kind)},
          {"condition", kind.condition},
          {"error", text_or_null(kind.failure)},
          {"by_degree", kind.failure.empty() ? by_degree : Json(nullptr)}};
}

/// Relative errors by degree, or null.
Json by_degree_json(const std::optional<std::vector<double>>& errors) {
  if (!errors) return nullptr;
  Json json = Json::array();
  for (std::size_t d = 0; d < errors->size(); ++d) {
    json.push_back({{"degree", d}, {"relative", (*errors)[d]}});
  }
  return json;
}

/// What each degree keeps of the tolerance, and what keeps it from it; null where none is known.
Json tolerance_json(const Scene& scene, const RunResult& run) {
  const std::vector<KeptTolerance> by_degree = kept_tolerance(scene, run);
  if (by_degree.empty()) return nullptr;
  Json json = Json::array();
  for (std::size_t d = 0; d < by_degree.size(); ++d) {
    const KeptTolerance& one = by_degree[d];
    const char* const limit = one.is_rounding ? "rounding" : "steps";
    json.push_back({{"degree", d},
                    {"allowed", one.asked},
                    {"error", one.error},
                    {"rounding", one.rounding},
                    {"kept", one.is_kept()},
                    {"kept_from_it_by", one.is_kept() ? Json(nullptr) : Json(limit)}});
  }
  return json;
}

/// How a run was split, and why.
Json arcs_json(const Scene& scene, const ArcStatistics& arcs) {
  const ArcPlan& plan = arcs.plan;
  Json speed_ups = Json::object();
  for (std::size_t i = 0; i < plan.speed_ups.size(); ++i) {
    speed_ups[std::to_string(ArcPlan::thread_counts[i])] = plan.speed_ups[i];
  }
  return {{"asked", scene.arcs ? Json(*scene.arcs) : Json("auto")},
          {"count", plan.arcs},
          {"reason", plan.reason},
          {"estimated_speed_up_by_threads", speed_ups},
          {"multiply_adds",
           {{"nominal_step", plan.nominal_multiply_adds},
            {"step", plan.step_multiply_adds},
            {"step_of_later_arcs", plan.arc_step_multiply_adds},
            {"composition", plan.composition_multiply_adds}}},
          {"compositions", arcs.compositions},
          {"threads", arcs.threads},
          {"nominal_seconds", arcs.nominal_seconds},
          {"arcs_seconds", arcs.arcs_seconds},
          {"composition_seconds", arcs.composition_seconds}};
}

/// Defects by degree, or null.
Json symplecticity_json(const std::vector<SymplecticityDefect>& defects) {
  if (defects.empty()) return nullptr;
  Json json = Json::array();
  for (const SymplecticityDefect& entry : defects) {
    json.push_back(
        {{"degree", entry.degree}, {"absolute", entry.absolute}, {"scaled", entry.scaled}});
  }
  return json;
}

/// The jets before the duration.
Json jets_json(const PropagationResult& result, const RunResult& run) {
  Json json = Json::array();
  for (std::size_t i = 0; i < run.jets.size(); ++i) {
    const JetAtTime& one = run.jets[i];
    const bool is_estimated = !one.error_estimate.empty();
    json.push_back({{"folder", time_folder(i)},
                    {"time_canonical", one.time},
                    {"time_s", one.time * result.scene.units.time_s},
                    {"nominal", one.nominal},
                    {"error_estimate_by_degree",
                     is_estimated ? by_degree_json(one.error_estimate) : Json(nullptr)}});
  }
  return json;
}

/// The polynomials in the scene's coordinates: what their file does not say.
Json polynomials_json(const PropagationResult& result, const RunResult& run) {
  const ChartedJet& charted = *run.charted;
  Json json = {{"coordinates", name_of(charted.coordinates.start)},
               {"end_coordinates", name_of(charted.coordinates.end)},
               {"error", text_or_null(charted.failure)},
               {"wall_seconds", charted.seconds}};
  if (!charted.failure.empty()) return json;
  const StoredJet description = describe_charted_jet(result, run);
  const SeriesNames names = series_names(description);
  json["file"] = polynomials_file;
  json["variables"] = names.of(names.variables);
  json["components"] = names.of(names.components);
  json["coefficients_per_component"] = charted.jet.front().size();
  json["nominal_final"] = charted.nominal_final;
  json["symplecticity_by_degree"] = symplecticity_json(charted.symplecticity);
  json["error_estimate_by_degree"] = by_degree_json(charted.error_estimate.by_degree);
  // What is relative to the coefficients of these says nothing.
  const DegreesWithoutDigits without = degrees_without_digits(result.scene, charted);
  json["degrees_of_errors_alone"] = without.negligible;
  json["error_estimate_failure"] = text_or_null(charted.error_estimate.failure);
  json["error_estimate_seconds"] = charted.error_estimate.seconds;
  if (!description.flow_box) return json;
  const ZonalGravity& field = description.flow_box->field;
  json["section"] = name_of(description.flow_box->section);
  json["field"] = {{"radius_canonical", field.radius}, {"J", field.J.values()}};
  return json;
}

Json run_json(const PropagationResult& result, const RunResult& run) {
  Json json = integrator_json(run.settings);
  json["error"] = text_or_null(run.failure);
  json["failed_checks"] = run.failed_checks;
  json["warnings"] = run_warnings(result.scene, run);
  if (!run.failure.empty()) {
    for (const char* key :
         {"checks", "steps", "rejected_steps", "vector_field_evaluations", "nominal_evaluations",
          "wall_seconds", "nominal_final", "energy_error", "exactness", "symplecticity_by_degree",
          "error_by_degree", "error_estimate_by_degree", "tolerance_by_degree", "position_error_m",
          "operations"}) {
      json[key] = nullptr;
    }
    return json;
  }
  json["checks"] = checks_json(run.checks);
  json["steps"] = run.statistics.steps;
  json["rejected_steps"] = run.statistics.rejected_steps;
  json["vector_field_evaluations"] = run.statistics.vector_field_evaluations;
  json["nominal_evaluations"] = run.statistics.nominal_evaluations;
  json["wall_seconds"] = run.statistics.wall_seconds;
  json["nominal_final"] = run.nominal_final;
  json["energy_error"] = run.energy_error;
  json["exactness"] = Json::array();
  for (const KindResult& kind : run.kinds)
    json["exactness"].push_back(exactness_json(result, kind));
  if (!result.scene.kinds || !result.problem.is_full_jet) json["exactness"] = nullptr;
  json["symplecticity_by_degree"] = symplecticity_json(run.symplecticity);
  for (std::size_t d = 0; d < run.integration_defects.size(); ++d) {
    json["symplecticity_by_degree"][d]["integration_scaled"] = run.integration_defects[d];
  }
  json["error_by_degree"] = by_degree_json(run.error_by_degree);
  json["error_estimate_by_degree"] = by_degree_json(run.error_estimate.by_degree);
  json["tolerance_by_degree"] = tolerance_json(result.scene, run);
  if (has_time_shift(run.statistics.left_out)) {
    json["time_shift_difference_by_degree"] = run.time_shift_difference.empty()
                                                  ? Json(nullptr)
                                                  : by_degree_json(run.time_shift_difference);
  }
  json["position_error_m"] = or_null(run.position_error_m);
  json["operations"] = operations_json(result, run);
  if (!run.jets.empty()) json["jets"] = jets_json(result, run);
  if (run.charted) json["polynomials"] = polynomials_json(result, run);
  if (run.arcs) json["arcs"] = arcs_json(result.scene, *run.arcs);
  return json;
}

}  // namespace

std::string summary_json(const PropagationResult& result) {
  const Scene& scene = result.scene;
  const auto names = variable_names(scene.system);
  Json components = Json::array();
  for (const std::size_t c : result.problem.components) components.push_back(names[c]);
  Json variables = Json::array();
  for (const std::size_t v : scene.variables) variables.push_back(names[v]);
  Json json = {{"scene", scene.name},
               {"title", scene.title},
               {"version", version},
               {"model", model_name(scene.system.model)},
               {"system", system_json(scene.system)},
               {"precision", scene.precision == Precision::extended ? "extended" : "double"},
               {"units", units_json(scene.units, scene.mass_kg)},
               {"order", scene.order},
               {"variables", variables},
               {"components", components},
               {"coefficients_per_component", result.problem.space->size()},
               {"duration_canonical", scene.duration},
               {"nominal_initial", scene.nominal},
               {"ephemeris", ephemeris_json(scene)},
               {"nominal_file", nominal_file_json(scene)},
               {"separation_canonical", or_null(scene.separation)},
               {"reference", nullptr}};
  if (!scene.system.own_names.empty()) json["state_names"] = scene.system.own_names;
  if (result.problem.system->parameters > 0) {
    json["state_parameters"] = result.problem.system->parameters;
  }
  if (scene.start_time != ClockTime::epoch()) {
    json["start_canonical"] = scene.start_time.in<double>();
  }
  if (!result.problem.system->is_autonomous()) json["autonomous"] = false;
  if (result.reference) {
    const ReferenceResult& reference = *result.reference;
    std::vector<double> state(scene.nominal.size(), 0);
    for (std::size_t i = 0; i < reference.jet.size(); ++i) {
      state[result.problem.components[i]] = static_cast<double>(reference.jet[i][0]);
    }
    json["reference"] = {
        {"method", "gauss"},
        {"precision", reference_arithmetic(scene.precision, reference.tolerance).name},
        {"stages", reference.stages},
        {"tolerance", reference.tolerance},
        {"steps", reference.statistics.steps},
        {"wall_seconds", reference.statistics.wall_seconds},
        {"nominal_final", state},
        {"uncertainty_by_degree", reference.uncertainty_by_degree}};
  }
  json["reference_error"] = text_or_null(result.reference_failure);
  json["relative_hamiltonian_error"] = text_or_null(result.relative_hamiltonian_failure);
  json["exit_code"] = exit_code(result);
  json["runs"] = Json::array();
  for (const RunResult& run : result.runs) json["runs"].push_back(run_json(result, run));
  json["operations"] = operations_json(result);
  json["skipped"] = skipped_json(result);
  json["warnings"] = scene.warnings;
  if (scene.eval) {
    json["eval"] = {{"tolerance_m", scene.eval->tolerance_m},
                    {"most_domains", scene.eval->most_domains}};
  }
  return json_text(json) + "\n";
}

}  // namespace hamjet::io
