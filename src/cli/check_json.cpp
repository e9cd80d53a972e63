#include "check_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>
#include <variant>

#include "../formats/relative_frame_text.hpp"
#include "../report/formation/drift_view.hpp"
#include "../report/propagation/force_table.hpp"
#include "../report/propagation/orbit_summary.hpp"
#include "../report/study_description.hpp"
#include "../scene/systems/system_json.hpp"
#include "../store/json_text.hpp"
#include "../store/json_values.hpp"
#include "../store/text_file.hpp"
#include "../studies/arcs.hpp"
#include "../studies/checks/force_sizes.hpp"
#include "../studies/flights/manoeuvred_flight.hpp"
#include "../studies/flights/relative_drift.hpp"
#include "../studies/uncertainty/sample_memory.hpp"
#include "../text/message_place.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/studies/propagation.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"

namespace hamjet::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The times of a study of relative motion.
template <class Settings>
Json times_json(const Settings& settings, const Scene& scene) {
  return {{"count", settings.times.size()},
          {"last_s", io::json_number(settings.times.back() * scene.units.time_s)}};
}

Json mean_elements_json(const Scene& scene) {
  const auto orbit = io::orbit_summary(scene);
  if (!orbit || !orbit->mean_elements) return nullptr;
  const OsculatingElements& mean = *orbit->mean_elements;
  return {{"a_km", convert<double>(mean.semi_major_axis_km)},
          {"e", convert<double>(mean.eccentricity)},
          {"i_deg", convert<double>(mean.inclination_deg)},
          {"raan_deg", convert<double>(mean.ascending_node_deg)},
          {"argp_deg", convert<double>(mean.argument_of_perigee_deg)},
          {"ma_deg", orbit->mean_anomaly_deg},
          {"relative_truncation", orbit->mean_truncation}};
}

Json facts(const RunOptions& options, const Scene& scene) {
  const std::size_t threads = thread_count(options);
  PropagationResult nothing_run;
  nothing_run.scene = scene;
  nothing_run.problem = make_problem(without_manoeuvres(scene), threads);
  Json json = Json::parse(io::summary_json(nothing_run));
  for (const char* of_runs : {"reference_error", "relative_hamiltonian_error", "exit_code", "runs",
                              "operations", "skipped"}) {
    json.erase(of_runs);
  }
  json["coordinates"] = name_of(scene.coordinates.start);
  json["end_coordinates"] = name_of(scene.coordinates.end);
  json["duration_s"] = io::json_number(scene.duration * scene.units.time_s);
  json["reference"] = scene.reference.has_value();
  json["kinds"] = scene.kinds ? Json(scene.kinds->size()) : Json(nullptr);
  json["memory_bytes"] = io::json_number(
      estimate_memory(scene, *nothing_run.problem.system, scene.variables.size(), threads));
  json["uncertainty_memory_bytes"] =
      scene.uncertainty ? io::json_number(sample_memory(scene)) : Json(nullptr);
  json["integrators"] = Json::array();
  for (const IntegratorSettings& settings : scene.integrators) {
    Json integrator = io::integrator_json(settings);
    if (scene.arcs != std::optional<std::size_t>(1)) {
      integrator["arcs"] =
          plan_arcs(scene, nothing_run.problem, settings, [](const std::string&, double) {
            stop_if_interrupted();
          }).arcs;
    }
    json["integrators"].push_back(integrator);
  }
  json["mean_elements"] = mean_elements_json(scene);
  if (scene.system.earth) json.update(io::table_json(io::force_table(force_sizes(scene))));
  json["deputy"] = nullptr;
  if (scene.deputy) {
    const auto array = [](const Eigen::Vector3d& v) { return Json{v[0], v[1], v[2]}; };
    json["deputy"] = {
        {"frame", io::frame_name(scene.deputy->frame)},
        {"derivatives", io::text_or_null(std::string(io::derivatives_name(scene.deputy->frame)))},
        {"position_m", array(scene.deputy->start.position_m)},
        {"velocity_m_s", array(scene.deputy->start.velocity_m_s)}};
    io::add_drift(json["deputy"], deputy_drift(scene), scene.deputy->start);
  }
  json["commands"] = io::commands_of(scene);
  json["transfer"] = scene.transfer ? times_json(*scene.transfer, scene) : Json(nullptr);
  json["validity"] = scene.validity ? times_json(*scene.validity, scene) : Json(nullptr);
  json["bounded_sizes_m"] = scene.bounded ? Json(scene.bounded->sizes_m) : Json(nullptr);
  json["deputies"] = scene.assignment ? Json(scene.assignment->deputies.size()) : Json(nullptr);
  return json;
}

/// One object for each line of the message, but the warnings, which are texts as in a summary.
Json failure_json(const std::string& file, std::string_view message) {
  Json json = {{"errors", Json::array()}, {"warnings", Json::array()}};
  while (!message.empty()) {
    const std::string_view line = io::take_line(message);
    if (line.starts_with(io::warning_head)) {
      json["warnings"].push_back(line);
      continue;
    }
    const io::PlacedMessage error = io::placed(line, file);
    json["errors"].push_back({{"file", io::or_null(error.file)},
                              {"line", io::or_null(error.line)},
                              {"column", io::or_null(error.column)},
                              {"key", io::or_null(error.key)},
                              {"message", error.problem}});
  }
  return json;
}

}  // namespace

int check_as_json(const RunOptions& options) {
  const std::string file = io::printable(*options.scene_file, std::string::npos);
  Json json = {{"file", file}, {"exit_code", 0}, {"errors", Json::array()}};
  try {
    std::visit(
        [&](const auto& study) {
          if constexpr (std::is_same_v<std::decay_t<decltype(study)>, Scene>) {
            json.update(facts(options, study));
          } else {
            json.update(Json{{"scene", study.name}, {"title", study.title}});
          }
        },
        read_study(options));
  } catch (const Error& error) {
    json["exit_code"] = error.exit_code();
    json.update(failure_json(file, error.what()));
    print(io::json_text(json) + "\n");
    throw;
  }
  print(io::json_text(json) + "\n");
  return 0;
}

}  // namespace hamjet::cli
