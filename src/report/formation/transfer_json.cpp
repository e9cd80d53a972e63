#include "transfer_json.hpp"

#include "../../scene/systems/system_json.hpp"
#include "../../store/json_values.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "burn_view.hpp"
#include "drift_view.hpp"
#include "feedback_errors_view.hpp"
#include "frame_columns.hpp"
#include "fuel_view.hpp"
#include "hamjet/version.hpp"
#include "impulse_view.hpp"
#include "thrust_view.hpp"
#include "transfer_tables.hpp"
#include "transfer_view.hpp"
#include "waypoint_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json seconds_json(const TransferSeconds& seconds) {
  return {{"propagation", seconds.propagation},
          {"singularities", seconds.singularities},
          {"inversion", seconds.inversion},
          {"solution", seconds.solution},
          {"study", seconds.study()},
          {"proof", seconds.proof},
          {"residual", seconds.residual},
          {"impulses", seconds.impulses},
          {"thrust", seconds.thrust},
          {"fuel", seconds.fuel},
          {"burns", seconds.burns}};
}

Json counts_json(const TransferCounts& counts) {
  return {{"times", counts.times},
          {"answered", counts.answered},
          {"near_singular", counts.near_singular},
          {"beyond_tolerance", counts.beyond_tolerance},
          {"beyond_tolerance_away_from_singularities", counts.beyond_tolerance_away},
          {"unanswered_away_from_singularities", counts.unanswered_away},
          {"refined", counts.refined},
          {"beyond_tolerance_and_refined_away_from_singularities", counts.corrected_away},
          {"refinement_failed", counts.refinement_failed},
          {"impulse_too_large", counts.over_impulse},
          {"through_keep_out", counts.kept_out},
          {"below_surface", counts.below_surface}};
}

Json misses_json(const TransferResult& result) {
  Json json = Json::array();
  for (const MissStatistics& entry : miss_statistics(result)) {
    json.push_back({{"answer", entry.answer},
                    {"count", entry.count},
                    {"median_m", json_number(entry.median_m)},
                    {"largest_m", json_number(entry.largest_m)}});
  }
  return json;
}

/// Along the coordinates that the scene's system has.
Json told_json(const Eigen::Vector3d& vector, std::size_t count) {
  Json json = Json::array();
  for (const double x : along_told_axes(vector, count)) json.push_back(json_number(x));
  return json;
}

}  // namespace

Json vector_json(const Eigen::Vector3d& vector) {
  return {json_number(vector[0]), json_number(vector[1]), json_number(vector[2])};
}

Json study_head_json(const Scene& scene, const std::string& study, const std::string& integrator) {
  return {{"scene", scene.name},
          {"title", scene.title},
          {"version", version},
          {"study", study},
          {"model", model_name(scene.system.model)},
          {"system", system_json(scene.system)},
          {"units", units_json(told_units(scene), scene.mass_kg)},
          {"order", scene.order},
          {"integrator", integrator}};
}

Json transfer_point_json(const TransferPoint& point, const Scene& scene) {
  Json json = row_json(transfer_columns(scene).view({point}, {1}), 0);
  json["after_arrival"] = nullptr;
  if (shown_answer(point) != nullptr) {
    const std::size_t count = told_coordinates(scene.system);
    json["after_arrival"] = {{"position_m", told_json(point.arrived.position_m, count)},
                             {"velocity_m_s", told_json(point.arrived.velocity_m_s, count)}};
    add_drift(json["after_arrival"], point.drift, point.arrived);
  }
  return json;
}

void add_chosen_by(Json& json, const ChosenCoordinates& coordinates) {
  json["chosen_by_reach_m"] = nullptr;
  for (const ChosenCoordinates::Reach& reach : coordinates.reaches) {
    json["chosen_by_reach_m"][std::string(name_of(reach.coordinates))] = json_number(reach.metres);
  }
}

Json transfer_summary_json(const TransferResult& result) {
  const Scene& scene = result.scene;
  const TransferSettings& settings = *scene.transfer;
  Json json = study_head_json(scene, "transfer", result.integrator);
  json.update(table_json(transfers_table(result)));
  add_chosen_by(json, result.coordinates);
  // Where no generating function is solved, none is named.
  json["kind"] =
      result.coordinates == JetCoordinates::cartesian ? Json(settings.kind) : Json(nullptr);
  json["tolerance_m"] = settings.tolerance_m;
  json["refine"] = settings.refine;
  json["refined_miss_m"] = settings.refine ? Json(settings.refined_miss_m) : Json(nullptr);
  json["singular_margin_s"] = settings.singular_margin * scene.units.time_s;
  json["budget_m_s"] = json_number(settings.budget_m_s);
  json["largest_impulse_m_s"] = json_number(settings.largest_impulse_m_s);
  json["keep_out_m"] = settings.keep_out_m ? vector_json(*settings.keep_out_m) : Json(nullptr);
  json["strict"] = settings.strict;
  json["ephemeris"] = ephemeris_json(scene);
  json["nominal_file"] = nominal_file_json(scene);
  const auto best = result.best_point();
  json["best"] = best ? transfer_point_json(result.points[*best], scene) : Json(nullptr);
  json["least_between_listed_times"] =
      result.least_between ? transfer_point_json(*result.least_between, scene) : Json(nullptr);
  json["budget_windows"] = nullptr;
  if (settings.budget_m_s) json.update(table_json(budget_windows_table(result)));
  json["primer_vector"] = primer_json(result);
  json["optimal_impulses"] = optimal_impulses_json(result);
  json["waypoints"] = waypoints_json(result);
  json["coasting_start"] = coasting_json(result);
  json["other_revolutions"] = revolutions_json(result);
  json["energy_optimal_thrust"] =
      result.thrust ? table_json(energy_optimal_table(result)) : Json(nullptr);
  if (result.thrust) json["energy_optimal_thrust"].update(table_json(thrust_profile_table(result)));
  if (result.thrust && result.thrust->feedback) {
    json["energy_optimal_thrust"]["feedback"] = table_json(feedback_table(result));
    if (result.scene.transfer->errors) {
      json["energy_optimal_thrust"]["feedback"].update(table_json(feedback_errors_table(result)));
    }
  }
  json["fuel_optimal_thrust"] = fuel_optimal_json(result);
  json["finite_burns"] = result.burns ? table_json(burns_table(result)) : Json(nullptr);
  json["counts"] = counts_json(count_points(result));
  json["misses_away_from_singularities"] = misses_json(result);
  json["position_singular_times"] = Json::array();
  const TableView singular = singular_times_table(result);
  for (const auto& [row, place] : singular.places_of_rows) {
    json["position_singular_times"].push_back(row_json(singular, row));
  }
  json["seconds"] = seconds_json(result.seconds);
  return json;
}

}  // namespace hamjet::io
