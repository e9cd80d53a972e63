#include <cmath>
#include <nlohmann/json.hpp>

#include "../../scene/system_json.hpp"
#include "../../store/json_values.hpp"
#include "hamjet/report/comparison_report.hpp"
#include "hamjet/version.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json statistics_json(const IntegrationStatistics& statistics) {
  return {{"steps", statistics.steps},
          {"rejected_steps", statistics.rejected_steps},
          {"vector_field_evaluations", statistics.vector_field_evaluations},
          {"nominal_evaluations", statistics.nominal_evaluations},
          {"wall_seconds", json_number(statistics.wall_seconds)}};
}

Json residual_json(const ExactnessResidual& residual) {
  return {{"degree", residual.degree},
          {"absolute", json_number(residual.absolute)},
          {"scaled", json_number(residual.scaled)},
          {"at_formation_scale", json_number(residual.at_formation_scale)}};
}

Json run_json(const ComparedRun& run) {
  Json json = {{"settings", integrator_json(run.settings)},
               {"series", run.series},
               {"order", run.order},
               {"failure", text_or_null(run.failure)},
               {"left_out", text_or_null(run.left_out)},
               {"statistics", statistics_json(run.statistics)},
               {"multiply_adds", json_number(run.multiply_adds)},
               {"memory_bytes", json_number(run.memory_bytes)},
               {"seconds", json_value(run.seconds)},
               {"median_seconds", nullptr},
               {"error_by_degree", json_value(run.error_by_degree)},
               {"largest_error", nullptr},
               {"error_estimate_by_degree", json_value(run.error_estimate_by_degree)},
               {"error_at_formation_m", json_number(run.error_at_formation_m)},
               {"exactness", Json::array()},
               {"exactness_failure", text_or_null(run.exactness_failure)},
               {"symplecticity", Json::array()},
               {"largest_symplecticity", nullptr},
               {"energy_error", json_number(run.energy_error)},
               {"corner", nullptr}};
  if (!run.seconds.empty()) json["median_seconds"] = json_number(run.median_seconds());
  if (!run.error_by_degree.empty()) json["largest_error"] = json_number(run.largest_error());
  for (const ExactnessEntry& entry : run.exactness) {
    Json row = residual_json(entry.residual);
    row["floor"] = entry.floor ? residual_json(*entry.floor) : Json(nullptr);
    json["exactness"].push_back(row);
  }
  for (const SymplecticityDefect& entry : run.symplecticity) {
    json["symplecticity"].push_back({{"degree", entry.degree},
                                     {"absolute", json_number(entry.absolute)},
                                     {"scaled", json_number(entry.scaled)}});
  }
  if (!run.symplecticity.empty()) {
    json["largest_symplecticity"] = json_number(run.largest_symplecticity());
  }
  if (run.corner) json["corner"] = corner_names()[static_cast<std::size_t>(*run.corner)];
  return json;
}

Json along_time_json(const RunAlongTime& run) {
  Json points = Json::array();
  for (const RunAlongTime::Point& point : run.points) {
    points.push_back({{"time_canonical", json_number(point.time)},
                      {"exactness", json_number(point.exactness)},
                      {"condition", json_number(point.condition)},
                      {"energy_error", json_number(point.energy_error)}});
  }
  return {{"label", run.label},
          {"failure", text_or_null(run.failure)},
          {"points", points},
          {"singular_times_canonical", run.singular_times},
          {"singular_times_not_searched", text_or_null(run.not_searched)}};
}

Json scene_json(const Scene& scene) {
  const auto names = variable_names(scene.system);
  Json variables = Json::array();
  for (const std::size_t v : scene.variables) variables.push_back(names[v]);
  Json integrators = Json::array();
  for (const IntegratorSettings& settings : scene.integrators) {
    integrators.push_back(integrator_json(settings));
  }
  return {{"name", scene.name},
          {"title", scene.title},
          {"model", json_value(scene.system.model)},
          {"precision", scene.precision == Precision::extended ? "extended" : "double"},
          {"units", fields_json(scene.units)},
          {"nominal_initial", json_value(scene.nominal)},
          {"duration_canonical", json_number(scene.duration)},
          {"order", scene.order},
          {"variables", variables},
          {"separation_canonical", json_number(scene.separation)},
          {"integrators", integrators},
          {"compare", fields_json(scene.comparison)}};
}

Json reference_json(const ComparisonResult& result) {
  const ReferenceResult& reference = result.reference;
  return {{"method", "gauss"},
          {"precision", "extended"},
          {"stages", reference.stages},
          {"tolerance", json_number(reference.tolerance)},
          {"statistics", statistics_json(reference.statistics)},
          {"uncertainty_by_degree", json_value(reference.uncertainty_by_degree)},
          {"cached", result.is_reference_cached}};
}

Json fit_json(const ConvergenceFit& fit) {
  return {{"series", fit.series},
          {"degree", fit.degree},
          {"slope", json_number(fit.slope)},
          {"expected", json_number(fit.expected)},
          {"agrees", fit.agrees()},
          {"extended_precision", fit.is_extended},
          {"arc", fit.arc},
          {"labels", fit.labels}};
}

template <class Values, class Convert>
Json list(const Values& values, Convert convert) {
  Json json = Json::array();
  for (const auto& value : values) json.push_back(convert(value));
  return json;
}

}  // namespace

std::string comparison_json(const ComparisonResult& result, const ReportOrigin& origin) {
  const Json json = {{"schema", 1},
                     {"complete", result.is_complete},
                     {"version", version},
                     {"command", origin.command},
                     {"date", origin.date},
                     {"processor", origin.processor},
                     {"determinants", origin.determinants},
                     {"scene", scene_json(result.scene)},
                     {"reference", reference_json(result)},
                     {"kind", result.kind ? Json(result.kind->name()) : Json(nullptr)},
                     {"kind_condition", json_number(result.kind_condition)},
                     {"smallest_claimed_error_m", result.smallest_claimed_error_m()},
                     {"separation_points", result.separation_points},
                     {"largest_exact_defect", json_number(largest_exact_defect)},
                     {"verdict", verdict(result)},
                     {"advice", advice(result)},
                     {"runs", list(result.runs, run_json)},
                     {"cost_runs", list(result.cost_runs, run_json)},
                     {"along_time", list(result.along_time, along_time_json)},
                     {"fits", list(result.fits, fit_json)}};
  // A text that is not UTF-8 (a command line may hold one) must not cost the results.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hamjet::io
