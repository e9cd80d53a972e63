#include "encounter_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "../../studies/formation/single_transfer.hpp"
#include "dated_scene.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

/// Axes of a CDM that do not rotate; ITRF, the third kind that the standard allows, rotates.
constexpr std::array<std::string_view, 2> frames_of_cdm = {"GCRF", "EME2000"};

ConjunctionObject object_of(const Scene& scene, const ApproachingSpacecraft& craft,
                            const std::string& name, const std::string& identifier) {
  ConjunctionObject object;
  object.object_designator = identifier;
  object.catalog_name = "NONE";
  object.object_name = name;
  object.international_designator = identifier;
  object.orbit_center = scene.ephemeris->center_name;
  object.reference_frame = name_of_axes(scene.ephemeris->reference_frame);
  const double length_km = scene.units.length_km;
  for (std::size_t i = 0; i < 3; ++i) {
    object.position_km[i] = craft.state[i] * length_km;
    object.velocity_km_s[i] = craft.state[3 + i] * length_km / scene.units.time_s;
  }
  const Matrix<double> covariance = craft.covariance.matrix();
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      object.covariance[i][j] =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  object.comments = model_comments(scene);
  object.comments.emplace_back("Covariance: of the start, carried linearly");
  return object;
}

}  // namespace

std::optional<std::string> encounter_message_lack(const Scene& scene,
                                                  const CollisionResult& result) {
  if (!scene.ephemeris) {
    return "the scene has no dates, must have a table [ephemeris] or a chief from a message";
  }
  const EphemerisSettings& settings = *scene.ephemeris;
  if (settings.time_system != "UTC") {
    return fmt::format("its dates are in UTC, got ephemeris.time_system {}", settings.time_system);
  }
  if (std::find(frames_of_cdm.begin(), frames_of_cdm.end(),
                name_of_axes(settings.reference_frame)) == frames_of_cdm.end()) {
    return fmt::format("its axes are GCRF or EME2000, got ephemeris.reference_frame {}",
                       settings.reference_frame);
  }
  if (result.is_cut_by_burn) {
    return "the burn at the start lies inside the passage, so that no probability is that of the "
           "encounter";
  }
  const UncertainApproach* const nearest = nearest_approach(result);
  if (nearest == nullptr) return "the means have no closest approach in the window";
  try {
    moment_of(scene, nearest->time);
  } catch (const Error& error) {
    return error.what();
  }
  return std::nullopt;
}

ConjunctionDataMessage encounter_message(const Scene& scene, const CollisionResult& result) {
  const UncertainApproach& nearest = *nearest_approach(result);
  const EphemerisSettings& settings = *scene.ephemeris;
  // A message is about the whole encounter, even where the scene's window cuts the passage.
  const std::array<double, 2> window = result.of_whole_passage
                                           ? std::array{result.whole_from_s, result.whole_to_s}
                                           : std::array{result.from_s, result.to_s};
  ConjunctionDataMessage message;
  message.comments = origin_comments(
      scene, fmt::format("The nearest of {} closest approaches from {:.6g} s to {:.6g} s after {}",
                         result.approaches.size(), window[0], window[1], settings.epoch));
  message.creation_date = current_epoch();
  message.originator = settings.originator;
  message.tca = moment_of(scene, nearest.time);
  message.message_id =
      fmt::format("{}-{}", scene.name, format_epoch(message.creation_date).substr(0, 19));
  message.miss_distance_m = nearest.distance_m;
  message.relative_speed_m_s = nearest.speed_m_s;
  const auto& [chief, deputy] = nearest.spacecraft;
  std::vector<double> difference(6);
  for (std::size_t i = 0; i < 6; ++i) difference[i] = deputy.state[i] - chief.state[i];
  const RelativeState relative =
      ChiefFrame(chief.state, metric_units(scene), RelativeFrame::rtn_inertial)
          .relative(difference);
  const auto three = [](const Eigen::Vector3d& v) { return std::array{v[0], v[1], v[2]}; };
  message.relative_position_m = three(relative.position_m);
  message.relative_velocity_m_s = three(relative.velocity_m_s);
  const CollisionProbability& p = probability_of_passage(result);
  if (has_whole_passage(result)) {
    message.collision_probability = p.probability;
    message.collision_probability_method = "TAYLOR-MAP-SAMPLING";
  }
  message.comments.push_back(
      fmt::format("Collision: nearer than {:.9g} m in that window: {:.6e}; {:g} % from {:.6e} to "
                  "{:.6e}; order {}",
                  result.watch.radius_m, p.probability, 100 * result.watch.confidence, p.lower,
                  p.upper, result.order));
  for (const std::string& warning : result.warnings) {
    message.comments.push_back("Warning: " + warning);
  }
  message.objects[0] = object_of(scene, chief, settings.object_name, settings.object_id);
  message.objects[1] = object_of(scene, deputy, settings.deputy_name, settings.deputy_id);
  return message;
}

}  // namespace hamjet::io
