#include "scene_nominal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "../../dynamics/celestial_bodies.hpp"
#include "../../formats/orbit_messages/message_agreement.hpp"
#include "../../store/text_file.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

/// The state that is taken from a message, and the metadata of this state.
struct ChosenState {
  OrbitMetadata metadata;
  OrbitState state;
};

/// The content of an orbit message, before it is compared with the scene.
struct MessageOfFile {
  ChosenState chosen;
  std::string format;
  std::vector<std::string> unused;
  std::optional<OrbitParameterMessage> parameters;  ///< content of an OPM
};

std::optional<Epoch> wanted_epoch(const TableReader& nominal) {
  if (!nominal.has("epoch")) return std::nullopt;
  return read_epoch(nominal, "epoch");
}

bool is_of(const EphemerisSegment& segment, const std::string& object) {
  return segment.metadata.object_name == object || segment.metadata.object_id == object;
}

/// The distinct objects of these blocks: by their names, or by their identifiers where several
/// objects share a name.
std::vector<std::string> objects_of(const std::vector<EphemerisSegment>& segments) {
  std::vector<std::string> names;
  std::vector<std::string> identifiers;
  const auto add = [](std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  for (const EphemerisSegment& segment : segments) {
    add(names, segment.metadata.object_name);
    add(identifiers, segment.metadata.object_id);
  }
  return identifiers.size() > names.size() ? identifiers : names;
}

std::string listed_objects(const std::vector<std::string>& objects) {
  return printable(listed({objects.begin(), objects.end()}));
}

/// The blocks of the object that the scene names or, without a name, of the only object.
std::vector<EphemerisSegment> wanted_segments(const TableReader& nominal,
                                              std::vector<EphemerisSegment> segments) {
  const std::vector<std::string> objects = objects_of(segments);
  if (!nominal.has("object")) {
    if (objects.size() > 1) {
      nominal.fail("object", fmt::format("missing, got a file of {} objects, must be one of: {}",
                                         objects.size(), listed_objects(objects)));
    }
    return segments;
  }
  const std::string object = nominal.text("object");
  std::erase_if(segments, [&](const EphemerisSegment& segment) { return !is_of(segment, object); });
  if (segments.empty()) {
    nominal.fail("object", fmt::format("not in the file, got {}, must be one of: {}",
                                       in_quotes(object), listed_objects(objects)));
  }
  const std::vector<std::string> chosen = objects_of(segments);
  if (chosen.size() > 1) {
    nominal.fail("object", fmt::format("the name of {} objects, got {}, must be one of: {}",
                                       chosen.size(), in_quotes(object), listed_objects(chosen)));
  }
  return segments;
}

/// The state at the wanted epoch or, without one, the first state; states that serve for
/// interpolation only are not considered.
ChosenState choose_state(const TableReader& nominal, const std::vector<EphemerisSegment>& segments,
                         const std::optional<Epoch>& wanted) {
  std::vector<ChosenState> found;
  std::optional<Epoch> nearest_epoch;
  for (const EphemerisSegment& segment : segments) {
    for (const OrbitState& state : segment.states) {
      if (!segment.is_useable(state.epoch)) continue;
      if (!wanted) return {segment.metadata, state};
      if (state.epoch == *wanted) found.push_back({segment.metadata, state});
      const auto distance = [&](const Epoch& epoch) {
        return std::abs(seconds_between(*wanted, epoch));
      };
      if (!nearest_epoch || distance(state.epoch) < distance(*nearest_epoch)) {
        nearest_epoch = state.epoch;
      }
    }
  }
  if (!nearest_epoch) {
    nominal.fail("oem_file",
                 "no state to start from, got a file with none from USEABLE_START_TIME to "
                 "USEABLE_STOP_TIME, must have one");
  }
  if (found.empty()) {
    nominal.fail("epoch",
                 fmt::format("no state of this epoch is in the file, got {}, must be one "
                             "of its epochs, for nothing is interpolated; the nearest is "
                             "{}",
                             in_quotes(nominal.text("epoch")), format_epoch(*nearest_epoch)));
  }
  const bool is_one = std::all_of(found.begin(), found.end(), [&](const ChosenState& other) {
    return other.state.position_km == found[0].state.position_km &&
           other.state.velocity_km_s == found[0].state.velocity_km_s;
  });
  if (!is_one) {
    nominal.fail("epoch", fmt::format("the file has {} different states of this epoch, as before "
                                      "and after a manoeuvre or in several frames, got {}, must "
                                      "be another epoch",
                                      found.size(), in_quotes(nominal.text("epoch"))));
  }
  return found[0];
}

/// Refuses a message whose centre is not that of the scene. `file` is the file's printable name.
void require_same_centre(const TableReader& nominal, std::string_view key,
                         const SceneCentre& centre, const OrbitMetadata& metadata,
                         const std::string& file) {
  const double mu = centre.system.mu_km3_s2;
  const CelestialBody* const body = body_named(metadata.center_name);
  const CelestialBody* const of_scene = body_with_mu(mu);
  const std::string got =
      fmt::format("got CENTER_NAME = {} in {}:{}", printable(metadata.center_name), file,
                  metadata.center_name_line);
  const std::string of_system =
      fmt::format("system.mu_km3_s2 = {}{}", mu,
                  of_scene != nullptr ? fmt::format(" of {}", of_scene->name) : "");
  if (body != nullptr && body != of_scene) {
    nominal.fail(
        key, fmt::format(
                 "another centre than the scene's, {} and {}, must be {}a mu near "
                 "{:.8g}",
                 got, of_system,
                 of_scene != nullptr ? fmt::format("a message about {}, or ", of_scene->name) : "",
                 body->mu_km3_s2));
  }
  if (body == nullptr && of_scene != nullptr && centre.stated_name != metadata.center_name) {
    nominal.fail(key, fmt::format("an unknown centre, {} and {}, must be {}, or "
                                  "ephemeris.center_name = {} in the scene to say that it is meant",
                                  got, of_system, of_scene->name, in_quotes(metadata.center_name)));
  }
  if (body != nullptr && body->name != "EARTH" && centre.system.J.any()) {
    nominal.fail(key,
                 fmt::format("zonal coefficients along the Earth's axis, {} and the frame {}, must "
                             "be position_km and velocity_km_s with z along the axis of {}, or "
                             "model = \"kepler\"",
                             got, metadata.reference_frame, body->name));
  }
}

/// Refuses an OPM whose mu is not that of the scene.
void require_same_mu(const TableReader& nominal, std::string_view key, double mu,
                     const OrbitParameterMessage& message, const std::string& file) {
  if (!message.gm_km3_s2 || std::abs(*message.gm_km3_s2 / mu - 1) <= gm_tolerance) return;
  nominal.fail(key, fmt::format("another mu than the scene's, got GM = {} in {}:{} and "
                                "system.mu_km3_s2 = {}, must agree to {:.0e}",
                                *message.gm_km3_s2, file, message.gm_line, mu, gm_tolerance));
}

/// The state that the elements of a message give, from the true anomaly; no value where they do not
/// describe an ellipse.
std::optional<CartesianState> state_of(const OrbitElements& elements, double mu) {
  if (!(elements.semi_major_axis_km > 0) || !(elements.eccentricity >= 0) ||
      !(elements.eccentricity < 1)) {
    return std::nullopt;
  }
  Extended true_anomaly_deg = elements.anomaly_deg;
  if (elements.is_mean_anomaly) {
    true_anomaly_deg = true_anomaly_of_eccentric_deg(
        eccentric_anomaly_of_mean_deg(true_anomaly_deg, elements.eccentricity),
        elements.eccentricity);
  }
  return state_from_elements(
      {elements.semi_major_axis_km, elements.eccentricity, elements.inclination_deg,
       elements.ascending_node_deg, elements.argument_of_perigee_deg, true_anomaly_deg},
      mu);
}

/// Warns if a message's elements do not belong to its state, which is used: one of the two is
/// wrong. They agree if the positions are within a thousandth of the distance, as for elements
/// rounded to four digits.
void warn_of_contradictory_elements(const TableReader& nominal, std::string_view key, double mu,
                                    const OrbitParameterMessage& message, const std::string& file) {
  constexpr double agreement = 1e-3;
  if (!message.elements) return;
  const OrbitElements& elements = *message.elements;
  const Eigen::Vector3d place(message.state.position_km.data());
  const Eigen::Vector3d velocity(message.state.velocity_km_s.data());
  const double distance = place.norm();
  const double of_elements_mu = message.gm_km3_s2.value_or(mu);
  const double a = 1 / (2 / distance - velocity.squaredNorm() / of_elements_mu);
  const auto other = state_of(elements, of_elements_mu);
  double between = 0;
  if (other) {
    const auto& x = other->position_km;
    between =
        (Eigen::Vector3d(convert<double>(x[0]), convert<double>(x[1]), convert<double>(x[2])) -
         place)
            .norm();
  }
  // The difference of the energies, as a fraction of that of the circle through the position.
  const double of_size = std::abs(distance / a - distance / elements.semi_major_axis_km);
  const bool is_other_conic = !other && a > 0;
  if (!is_other_conic && between <= agreement * distance && of_size <= agreement) return;
  nominal.warn(
      key,
      fmt::format(
          "Keplerian elements that are not those of the state, got SEMI_MAJOR_AXIS = {} km "
          "in {}:{}{} beside a state whose own is {:.8g} km, should agree; the state is "
          "used, the elements are not",
          elements.semi_major_axis_km, file, elements.line,
          other ? fmt::format(" and a place {} from the state's", length_text(1000 * between)) : "",
          a));
}

EphemerisSettings settings_of(const ChosenState& chosen) {
  EphemerisSettings settings;
  settings.epoch = format_epoch(chosen.state.epoch);
  settings.time_system = time_system_name(chosen.metadata.time_system);
  settings.reference_frame = chosen.metadata.reference_frame;
  settings.center_name = chosen.metadata.center_name;
  if (chosen.metadata.reference_frame_epoch) {
    settings.reference_frame_epoch = format_epoch(*chosen.metadata.reference_frame_epoch);
  }
  settings.object_name = chosen.metadata.object_name;
  settings.object_id = chosen.metadata.object_id;
  return settings;
}

/// Reads `key`, oem_file or opm_file, and takes from the message what the other keys select.
MessageOfFile read_message(const TableReader& nominal, std::string_view key,
                           AcceptedFrames frames) {
  const std::string file = printable_path(nominal.path_beside_scene(key));
  const std::string text = nominal.content_beside_scene(key, largest_orbit_message_bytes);
  const auto epoch = wanted_epoch(nominal);
  MessageOfFile result;
  if (key == "oem_file") {
    OrbitEphemerisMessage message = read_oem(file, text, frames);
    result.format = "OEM " + message.version;
    const auto segments = wanted_segments(nominal, std::move(message.segments));
    result.chosen = choose_state(nominal, segments, epoch);
    const auto add_if_any = [&](bool EphemerisSegment::*has, const char* name) {
      const bool is_there =
          std::any_of(segments.begin(), segments.end(),
                      [&](const EphemerisSegment& segment) { return segment.*has; });
      if (is_there) result.unused.emplace_back(name);
    };
    add_if_any(&EphemerisSegment::has_acceleration, "accelerations");
    add_if_any(&EphemerisSegment::has_covariance, "covariance");
    return result;
  }
  result.parameters = read_opm(file, text, frames);
  const OrbitParameterMessage& message = *result.parameters;
  result.format = "OPM " + message.version;
  result.unused = message.unused;
  result.chosen = {message.metadata, message.state};
  const auto refuse_key = [&](std::string_view other, const std::string& of_message) {
    nominal.fail(other, fmt::format("not that of the message, got {}, must be {} or left out",
                                    in_quotes(nominal.text(other)), in_quotes(of_message)));
  };
  if (epoch && *epoch != message.state.epoch) {
    refuse_key("epoch", format_epoch(message.state.epoch));
  }
  if (nominal.has("object") && nominal.text("object") != message.metadata.object_name &&
      nominal.text("object") != message.metadata.object_id) {
    refuse_key("object", message.metadata.object_name);
  }
  return result;
}

}  // namespace

AcceptedFrames frames_of(const SystemSettings& system) {
  return system.earth ? AcceptedFrames::terrestrial_too : AcceptedFrames::inertial;
}

std::optional<EphemerisSettings> settings_of_orbit_file(const TableReader& table) {
  for (const std::string_view key : {"oem_file", "opm_file"}) {
    if (table.has(key))
      return settings_of(read_message(table, key, AcceptedFrames::terrestrial_too).chosen);
  }
  return std::nullopt;
}

std::optional<OpmSpacecraft> spacecraft_of_orbit_file(const TableReader& table) {
  if (!table.has("opm_file")) return std::nullopt;
  return read_message(table, "opm_file", AcceptedFrames::terrestrial_too).parameters->spacecraft;
}

OrbitParameterMessage parameters_of_orbit_file(const TableReader& table) {
  return *read_message(table, "opm_file", AcceptedFrames::terrestrial_too).parameters;
}

std::optional<Epoch> epoch_of_nominal_file(const TableReader& nominal) {
  const auto settings = settings_of_orbit_file(nominal);
  return settings ? parse_epoch(settings->epoch) : std::nullopt;
}

NominalFromFile read_nominal_file(const TableReader& nominal, const SceneCentre& centre) {
  const std::string_view key = nominal.exactly_one_of({"oem_file", "opm_file"});
  const std::string file = printable_path(nominal.path_beside_scene(key));
  MessageOfFile message = read_message(nominal, key, frames_of(centre.system));
  if (message.parameters) {
    require_same_mu(nominal, key, centre.system.mu_km3_s2, *message.parameters, file);
  }
  const ChosenState& chosen = message.chosen;
  require_same_centre(nominal, key, centre, chosen.metadata, file);
  const auto& position = chosen.state.position_km;
  if (std::all_of(position.begin(), position.end(), [](double x) { return x == 0; })) {
    nominal.fail(key, "at the centre of attraction, got the position 0 0 0, must be any other");
  }
  if (message.parameters) {
    nominal.warn(key, message.parameters->doubts);
    warn_of_contradictory_elements(nominal, key, centre.system.mu_km3_s2, *message.parameters,
                                   file);
  }
  NominalFromFile result;
  std::copy(position.begin(), position.end(), result.state.position_km.begin());
  std::copy(chosen.state.velocity_km_s.begin(), chosen.state.velocity_km_s.end(),
            result.state.velocity_km_s.begin());
  result.file.path = nominal.text(key);
  result.file.format = std::move(message.format);
  result.file.unused = std::move(message.unused);
  result.file.ephemeris = settings_of(chosen);
  return result;
}

}  // namespace hamjet::io
