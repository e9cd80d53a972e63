#include "transfer_json.hpp"

#include "../../formats/relative_frame_text.hpp"
#include "../../scene/system_json.hpp"
#include "../../store/json_values.hpp"
#include "drift_view.hpp"
#include "hamjet/version.hpp"
#include "impulse_view.hpp"
#include "transfer_view.hpp"
#include "waypoint_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json seconds_json(const TransferSeconds& seconds) {
  return {{"propagation", seconds.propagation}, {"singularities", seconds.singularities},
          {"inversion", seconds.inversion},     {"solution", seconds.solution},
          {"study", seconds.study()},           {"proof", seconds.proof},
          {"residual", seconds.residual},       {"impulses", seconds.impulses}};
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

Json windows_json(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  Json json = Json::array();
  for (const BudgetWindow& window : result.budget_windows) {
    json.push_back({{"first_s", window.first * unit},
                    {"last_s", window.last * unit},
                    {"begins_at_first_time", window.begins_before},
                    {"ends_at_last_time", window.ends_after}});
  }
  return json;
}

Json singular_time_json(const SingularTime& singular, const Scene& scene) {
  return {{"time_canonical", told_time(scene, singular.time)},
          {"time_s", singular.time * scene.units.time_s},
          {"resolution_s", singular.resolution * scene.units.time_s},
          {"smallest_ratio", json_number(singular.smallest_ratio)},
          {"second_ratio", json_number(singular.second_ratio)},
          {"directions_lost", singular.directions_lost},
          {"direction_inertial", vector_json(singular.direction)},
          {"direction_rtn",
           singular.direction_rtn ? vector_json(*singular.direction_rtn) : Json(nullptr)}};
}

}  // namespace

Json vector_json(const Eigen::Vector3d& vector) {
  return {json_number(vector[0]), json_number(vector[1]), json_number(vector[2])};
}

Json study_head_json(const Scene& scene, const std::string& study, const std::string& integrator) {
  return {
      {"scene", scene.name},
      {"title", scene.title},
      {"version", version},
      {"study", study},
      {"model", model_name(scene.system.model)},
      {"system", system_json(scene.system)},
      {"units", {{"length_km", told_units(scene).length_km}, {"time_s", told_units(scene).time_s}}},
      {"order", scene.order},
      {"integrator", integrator}};
}

Json transfer_point_json(const TransferPoint& point, const Scene& scene) {
  const TransferAnswer* answer = shown_answer(point);
  const TransferAnswer* linear = answer_of_order(point, 1);
  Json json = {{"time_canonical", told_time(scene, point.time)},
               {"time_s", point.time * scene.units.time_s},
               {"kind", point.kind ? Json(point.kind->name()) : Json(nullptr)},
               {"condition", point.kind ? json_number(point.condition) : Json(nullptr)},
               {"near_singular", point.is_near_singular},
               {"beyond_tolerance", point.is_beyond_tolerance},
               {"exceeds_impulse", point.exceeds_impulse},
               {"keep_out_ratio", json_number(point.keep_out_ratio)},
               {"lowest_km",
                point.lowest ? json_number(*point.lowest * scene.units.length_km) : Json(nullptr)},
               {"below_surface", point.is_below_surface},
               {"answer", text_or_null(answer_name(point))},
               {"start_change_m_s", nullptr},
               {"end_change_m_s", nullptr},
               {"total_change_m_s", nullptr},
               {"miss_m", nullptr},
               {"linear_total_change_m_s", nullptr},
               {"linear_miss_m", nullptr},
               {"miss_m_by_order", Json::array()},
               {"failure", text_or_null(failure_text(point))}};
  if (answer != nullptr) {
    json["start_change_m_s"] = vector_json(answer->start_change_m_s);
    json["end_change_m_s"] = vector_json(answer->end_change_m_s);
    json["total_change_m_s"] = json_number(answer->total_change_m_s());
    json["miss_m"] = json_number(answer->miss_m);
  }
  if (linear != nullptr) {
    json["linear_total_change_m_s"] = json_number(linear->total_change_m_s());
    json["linear_miss_m"] = json_number(linear->miss_m);
  }
  json["after_arrival"] = nullptr;
  if (answer != nullptr) {
    json["after_arrival"] = {{"position_m", vector_json(point.arrived.position_m)},
                             {"velocity_m_s", vector_json(point.arrived.velocity_m_s)}};
    add_drift(json["after_arrival"], point.drift, point.arrived);
  }
  for (const TransferAnswer& entry : point.answers) {
    json["miss_m_by_order"].push_back(entry.failure.empty() ? json_number(entry.miss_m)
                                                            : Json(nullptr));
  }
  return json;
}

void add_coordinates(Json& json, const ChosenCoordinates& coordinates) {
  json["coordinates"] = name_of(coordinates.start);
  json["end_coordinates"] = name_of(coordinates.end);
  json["chosen_by_reach_m"] = nullptr;
  for (const ChosenCoordinates::Reach& reach : coordinates.reaches) {
    json["chosen_by_reach_m"][std::string(name_of(reach.coordinates))] = json_number(reach.metres);
  }
}

Json transfer_summary_json(const TransferResult& result) {
  const Scene& scene = result.scene;
  const TransferSettings& settings = *scene.transfer;
  Json json = study_head_json(scene, "transfer", result.integrator);
  add_coordinates(json, result.coordinates);
  json["frame"] = frame_name(settings.frame);
  json["derivatives"] = text_or_null(std::string(derivatives_name(settings.frame)));
  json["axes"] = axis_letters(settings.frame);
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
  json["verdict"] = transfer_verdict(result);
  const auto best = result.best_point();
  json["best"] = best ? transfer_point_json(result.points[*best], scene) : Json(nullptr);
  json["is_first_or_last_time"] =
      best && result.points.size() > 1 && (*best == 0 || *best + 1 == result.points.size());
  json["least_between_listed_times"] =
      result.least_between ? transfer_point_json(*result.least_between, scene) : Json(nullptr);
  json["times_between_listed"] = result.times_between;
  json["budget_windows"] = settings.budget_m_s ? windows_json(result) : Json(nullptr);
  json["primer_vector"] = primer_json(result);
  json["optimal_impulses"] = optimal_impulses_json(result);
  json["waypoints"] = waypoints_json(result);
  json["coasting_start"] = coasting_json(result);
  json["other_revolutions"] = revolutions_json(result);
  json["counts"] = counts_json(count_points(result));
  json["misses_away_from_singularities"] = misses_json(result);
  json["position_singular_times"] = Json::array();
  for (const SingularTime& singular : result.position_singularities()) {
    json["position_singular_times"].push_back(singular_time_json(singular, scene));
  }
  json["flight_floor_m"] = json_number(result.flight_floor_m);
  json["chief_error_m"] = json_number(result.chief_error_m);
  json["largest_hamilton_jacobi_residual"] = json_number(largest_hamilton_jacobi_residual(result));
  json["hamilton_jacobi_floor"] = json_number(result.hamilton_jacobi_floor);
  json["steps"] = result.statistics.steps;
  json["seconds"] = seconds_json(result.seconds);
  return json;
}

}  // namespace hamjet::io
