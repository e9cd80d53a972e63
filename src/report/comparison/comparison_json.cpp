#include <nlohmann/json.hpp>

#include "../../scene/systems/system_json.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/reference.hpp"
#include "compared_run_members.hpp"
#include "comparison_view.hpp"
#include "hamjet/report/comparison_report.hpp"
#include "hamjet/version.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

template <class Values, class Convert>
Json json_list(const Values& values, Convert convert) {
  Json json = Json::array();
  for (const auto& value : values) json.push_back(convert(value));
  return json;
}

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

Json member_json(const IntegratorSettings& settings) { return integrator_json(settings); }
Json member_json(const IntegrationStatistics& statistics) { return statistics_json(statistics); }
Json member_json(const std::string& text) { return text_or_null(text); }
Json member_json(const std::optional<Corner>& corner) {
  return corner ? Json(corner_text(*corner)) : Json(nullptr);
}
Json member_json(const ExactnessEntry& entry) {
  Json json = residual_json(entry.residual);
  json["floor"] = entry.floor ? residual_json(*entry.floor) : Json(nullptr);
  return json;
}
Json member_json(const SymplecticityDefect& entry) {
  return {{"degree", entry.degree},
          {"absolute", json_number(entry.absolute)},
          {"scaled", json_number(entry.scaled)}};
}
template <class Number>
Json member_json(const Number& number) {
  return json_value(number);
}
template <class Entry>
Json member_json(const std::vector<Entry>& entries) {
  return json_list(entries, [](const Entry& entry) { return member_json(entry); });
}

Json run_json(const ComparedRun& run) {
  Json json;
  for_each_member(run, [&](std::string_view name, const auto& member) {
    json[std::string(name)] = member_json(member);
    if (name == "seconds") json["median_seconds"] = json_number(median_seconds(run));
    if (name == "error_by_degree") json["largest_error"] = json_number(largest_error(run));
    if (name == "symplecticity") {
      json["largest_symplecticity"] = json_number(largest_symplecticity(run));
    }
  });
  return json;
}

Json along_time_json(const RunAlongTime& run) {
  const Json points = json_list(run.points, [](const RunAlongTime::Point& point) -> Json {
    return {{"time_canonical", json_number(point.time)},
            {"exactness", json_number(point.exactness)},
            {"condition", json_number(point.condition)},
            {"energy_error", json_number(point.energy_error)}};
  });
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
          {"integrators", json_list(scene.integrators, integrator_json)},
          {"compare", fields_json(scene.comparison)}};
}

Json reference_json(const ComparisonResult& result) {
  const ReferenceResult& reference = result.reference;
  return {{"method", "gauss"},
          {"precision", reference_arithmetic(result.scene.precision, reference.tolerance).name},
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
                     {"runs", json_list(result.runs, run_json)},
                     {"cost_runs", json_list(result.cost_runs, run_json)},
                     {"along_time", json_list(result.along_time, along_time_json)},
                     {"fits", json_list(result.fits, fit_json)}};
  // A text that is not UTF-8 (a command line may hold one) must not cost the results.
  return json_text(json, 1) + "\n";
}

}  // namespace hamjet::io
