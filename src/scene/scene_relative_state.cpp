#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../formats/orbit_messages/message_agreement.hpp"
#include "../formats/relative_frame_text.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "scene_relative_motion.hpp"
#include "starts/scene_orbit.hpp"
#include "systems/scene_earth.hpp"

namespace hamjet::io {
namespace {

/// The number of components of a vector: those of the system's own coordinates, of which studies of
/// deviations have up to three.
std::size_t components_of_vectors(const Nominal& nominal) {
  return nominal.orbit ? 3 : std::min<std::size_t>(3, nominal.state.size() / 2);
}

/// Reads a vector; coordinates that the system does not have are 0. A deputy as far from its chief
/// as the centre of attraction, or as fast as the orbit itself, is beyond every expansion.
Eigen::Vector3d read_vector(const TableReader& table, std::string_view key, std::size_t count,
                            double limit, std::string_view what) {
  std::vector<double> numbers = table.numbers(key, count);
  numbers.resize(3, 0.0);
  const Eigen::Vector3d vector(numbers[0], numbers[1], numbers[2]);
  if (!(vector.stableNorm() < limit)) {
    table.fail(key, fmt::format("too large, got a magnitude of {:.4g}, must be below {:.4g}, {}",
                                vector.stableNorm(), limit, what));
  }
  return vector;
}

MetricUnits metric_units(const Nominal& nominal) {
  const CanonicalUnits units = canonical_units(nominal.scale);
  return {units.length_km * 1000, units.time_s};
}

double distance_of(const Nominal& nominal) { return Eigen::Vector3d(nominal.state.data()).norm(); }

/// The speed of the circular orbit through the chief, in canonical units, where mu = 1.
double circular_speed_of(const Nominal& nominal) { return 1 / std::sqrt(distance_of(nominal)); }

/// The axes at the chief. If there are none, the error refers to the table.
ChiefFrame frame_at_chief(const TableReader& table, const Nominal& nominal, RelativeFrame frame) {
  try {
    return {nominal.state, metric_units(nominal), frame};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    table.fail("frame", fmt::format("not defined at this chief, got {}, must be \"inertial\": {}",
                                    frame_text(frame), error.what()));
  }
}

/// Refuses a message whose state is not at the chief's moment, is in other axes, or is about
/// another centre. If the scene's mu is that of no known body, only the names of the centres can be
/// compared.
void require_same_date(const TableReader& table, const Nominal& nominal,
                       const EphemerisSettings& message) {
  const std::string_view file = table.exactly_one_of({"oem_file", "opm_file"});
  if (!nominal.ephemeris) {
    table.fail(file,
               fmt::format("a dated state beside a chief without a date, got {} {}, must have "
                           "a table [ephemeris] that says the chief's epoch, or a chief from "
                           "a message",
                           message.epoch, message.time_system));
  }
  const EphemerisSettings& chief = *nominal.ephemeris;
  const bool is_of_earth = nominal.centre.system.earth.has_value();
  const bool is_same_moment =
      is_of_earth ? is_at_start(*nominal.centre.system.earth, parse_epoch(message.epoch).value(),
                                message.time_system)
                  : parse_epoch(message.epoch) == parse_epoch(chief.epoch) &&
                        message.time_system == chief.time_system;
  if (!is_same_moment) {
    table.fail(table.has("epoch") ? "epoch" : file,
               fmt::format("a state of another moment than the chief's, got {} {}, must be {} {}",
                           message.epoch, message.time_system, chief.epoch, chief.time_system));
  }
  // States about the real Earth are turned into the axes in which both are flown.
  if (!is_of_earth && !is_same_axes(message, chief)) {
    table.fail(file, fmt::format("a state in other axes than the chief's, got {}, must be {}",
                                 axes_text(message.reference_frame, message.reference_frame_epoch),
                                 axes_text(chief.reference_frame, chief.reference_frame_epoch)));
  }
  if (!is_same_centre(message.center_name, chief.center_name)) {
    table.fail(file,
               fmt::format("a state about another centre than the chief's, got {}, must be {}",
                           printable(message.center_name), printable(chief.center_name)));
  }
}

/// Refuses a deputy, given by its canonical deviation, that is beyond every expansion.
void require_near(const TableReader& table, const Nominal& nominal,
                  std::span<const double> deviation) {
  const double separation = Eigen::Vector3d(deviation.data()).stableNorm();
  if (!(separation < distance_of(nominal))) {
    const double unit_km = canonical_units(nominal.scale).length_km;
    table.fail("", fmt::format("too far from its chief, got {} between the two, must be "
                               "below {}, the chief's distance from the centre; beside the chief "
                               "are position_m and velocity_m_s",
                               length_text(1000 * separation * unit_km, 6),
                               length_text(1000 * distance_of(nominal) * unit_km, 6)));
  }
  const double speed = Eigen::Vector3d(deviation.data() + 3).stableNorm();
  if (!(speed < circular_speed_of(nominal))) {
    const double unit_km_s = metric_units(nominal).velocity_m_s() / 1000;
    table.fail("", fmt::format("too fast beside its chief, got {:.6g} km/s between the two, must "
                               "be below {:.6g} km/s, the speed of a circular orbit through the "
                               "chief; beside the chief are position_m and velocity_m_s",
                               speed * unit_km_s, circular_speed_of(nominal) * unit_km_s));
  }
}

/// The relative state of a deputy that is given by its own orbit: the difference of two inertial
/// states, both before any rounding.
RelativeState read_own_orbit(const TableReader& table, const Nominal& nominal, RelativeFrame frame,
                             DeputyPlace place) {
  if (table.has("position_km") && !table.has("velocity_km_s")) {
    table.fail(
        "velocity_km_s",
        "missing beside position_km, a place from the centre of attraction, must be [vx, vy, "
        "vz]; a place relative to the chief is position_m");
  }
  const Orbit deputy = read_orbit(table, nominal.centre);
  if (deputy.file) require_same_date(table, nominal, deputy.file->ephemeris);
  const CanonicalScale& scale = nominal.scale;
  std::vector<double> deviation;
  for (std::size_t i = 0; i < 3; ++i) {
    deviation.push_back(convert<double>(
        (deputy.state.position_km[i] - nominal.orbit->position_km[i]) / scale.length_km));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    deviation.push_back(
        convert<double>((deputy.state.velocity_km_s[i] - nominal.orbit->velocity_km_s[i]) *
                        scale.time_s / scale.length_km));
  }
  if (place == DeputyPlace::near_chief) require_near(table, nominal, deviation);
  return frame_at_chief(table, nominal, frame).relative(deviation);
}

/// The first key of a form that the table has.
std::optional<std::string_view> key_of_form(const TableReader& table, DeputyForm form) {
  for (const DeputyComponent& component : components_of(form)) {
    if (table.has(component.name)) return component.name;
  }
  return std::nullopt;
}

/// The six numbers of the form; those left out are 0.
std::array<double, 6> numbers_of_form(const TableReader& table, DeputyForm form) {
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string_view key = components_of(form)[i].name;
    if (table.has(key)) numbers[i] = table.number(key);
  }
  return numbers;
}

/// The relative state of a deputy whose table has numbers of this form.
RelativeState read_in_form(const TableReader& table, const Nominal& nominal, RelativeFrame frame,
                           DeputyForm form, DeputyPlace place) {
  const std::array<double, 6> numbers = numbers_of_form(table, form);
  const std::string_view first = *key_of_form(table, form);
  std::array<double, 6> deviation{};
  try {
    // In the canonical units of an orbit mu is 1.
    deviation = DeputyCoordinates(nominal.state, metric_units(nominal), 1, form).deviation(numbers);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    table.fail(first, fmt::format("no state of a deputy, got {} of {}, must be numbers of an "
                                  "orbit, or another form: {}",
                                  name_of(form), fmt::join(numbers, ", "), error.what()));
  }
  if (place == DeputyPlace::near_chief) require_near(table, nominal, deviation);
  return frame_at_chief(table, nominal, frame).relative(deviation);
}

/// A state relative to the chief, along the axes of the frame.
RelativeState read_along_axes(const TableReader& table, const Nominal& nominal,
                              DeputyPlace place = DeputyPlace::near_chief) {
  const MetricUnits units = metric_units(nominal);
  const bool is_near = place == DeputyPlace::near_chief && nominal.orbit.has_value();
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  const std::size_t count = components_of_vectors(nominal);
  RelativeState state;
  state.position_m = read_vector(table, "position_m", count,
                                 is_near ? distance_of(nominal) * units.length_m : no_limit,
                                 "the chief's distance from the centre");
  if (table.has("velocity_m_s")) {
    state.velocity_m_s =
        read_vector(table, "velocity_m_s", count,
                    is_near ? circular_speed_of(nominal) * units.velocity_m_s() : no_limit,
                    "the speed of a circular orbit through the chief");
  }
  return state;
}

/// How a table gives a deputy. If both members are absent, it is given along the axes of the frame.
struct GivenForm {
  std::optional<DeputyForm> form;
  bool is_own_orbit = false;
};

GivenForm form_of(const TableReader& table, const Nominal& nominal) {
  struct Given {
    std::string_view key;
    GivenForm form;
  };
  std::vector<Given> given;
  if (const auto own = orbit_key_of(table)) given.push_back({*own, {{}, true}});
  for (const DeputyForm form : nonlinear_forms) {
    if (const auto key = key_of_form(table, form)) given.push_back({*key, {form}});
  }
  for (const std::string_view key : {"position_m", "velocity_m_s"}) {
    if (table.has(key)) given.push_back({key, {}});
  }
  if (!nominal.orbit) {
    if (given.empty()) {
      table.fail("position_m",
                 fmt::format("missing, must be an array of {}, the deviation of the coordinates "
                             "from the nominal",
                             counted(components_of_vectors(nominal), "finite number")));
    }
    for (const Given& one : given) {
      if (!one.form.is_own_orbit && !one.form.form) continue;
      table.fail(one.key,
                 "a form of deputies in an orbit, must be position_m and velocity_m_s: "
                 "this system has no orbit");
    }
  }
  if (given.empty()) {
    table.fail("position_m",
               fmt::format("missing, must be an array of 3 finite numbers, or the deputy must have "
                           "another form: its own orbit in the keys of [nominal], or {}, {} or {} "
                           "({}, {}, {} and so on)",
                           name_of(nonlinear_forms[0]), name_of(nonlinear_forms[1]),
                           name_of(nonlinear_forms[2]), components_of(nonlinear_forms[0])[1].name,
                           components_of(nonlinear_forms[1])[1].name,
                           components_of(nonlinear_forms[2])[1].name));
  }
  const GivenForm& first = given[0].form;
  if (given.size() > 1 && (first.is_own_orbit || first.form)) {
    table.fail(given[1].key,
               fmt::format("two forms of a deputy, got {} and {}, must be one of: its state "
                           "relative to the chief, {}, {}, {}, or its own orbit",
                           given[0].key, given[1].key, name_of(nonlinear_forms[0]),
                           name_of(nonlinear_forms[1]), name_of(nonlinear_forms[2])));
  }
  return first;
}

}  // namespace

std::vector<SceneKey> axes_keys() {
  // A system of the scene's own may have fewer coordinates than three.
  const ValueForm vector = form::words("array of 3 numbers", form::array(form::number(), 3));
  return {{"position_m", vector, absent::refused(),
           "relative to the chief, along the axes of the frame; below its distance from the "
           "centre; of a system of one or two coordinates as many numbers"},
          {"velocity_m_s", vector, absent::other("0, at rest in the frame"),
           "below the speed of a circular orbit through the chief"}};
}

std::vector<SceneKey> relative_state_keys() {
  std::vector<SceneKey> keys = axes_keys();
  keys[0].absence = absent::other("another form of the deputy");
  for (const DeputyForm form : nonlinear_forms) {
    for (const DeputyComponent& component : components_of(form)) {
      keys.push_back({component.name, form::number(),
                      absent::other("0, or another form of the deputy"), component.help});
    }
  }
  return joined<SceneKey>({keys, orbit_keys()});
}

std::vector<SceneKey> arrival_keys() {
  std::vector<SceneKey> keys = relative_state_keys();
  // A message is for one moment, but an arrival for as many moments as there are transfer times.
  std::erase_if(keys, [](const SceneKey& key) {
    return key.name == "opm_file" || key.name == "oem_file" || key.name == "epoch" ||
           key.name == "object" || key.name == "manoeuvres";
  });
  return keys;
}

RelativeState read_relative_state(const TableReader& table, const Nominal& nominal,
                                  RelativeFrame frame, DeputyPlace place) {
  const GivenForm given = form_of(table, nominal);
  if (given.is_own_orbit) return read_own_orbit(table, nominal, frame, place);
  if (given.form) return read_in_form(table, nominal, frame, *given.form, place);
  return read_along_axes(table, nominal, place);
}

ArrivalState read_arrival(const TableReader& table, const Nominal& nominal) {
  const GivenForm given = form_of(table, nominal);
  ArrivalState arrival;
  if (given.form) {
    arrival.in_form = {*given.form, numbers_of_form(table, *given.form)};
  } else if (given.is_own_orbit) {
    const Orbit orbit = read_orbit(table, nominal.centre);
    const CanonicalScale& scale = nominal.scale;
    std::array<double, 6> state{};
    for (std::size_t i = 0; i < 3; ++i) {
      state[i] = convert<double>(orbit.state.position_km[i] / scale.length_km);
      state[3 + i] = convert<double>(orbit.state.velocity_km_s[i] * scale.time_s / scale.length_km);
    }
    arrival.own_state = state;
  } else {
    arrival = read_along_axes(table, nominal);
  }
  return arrival;
}

RelativeState read_place(const TableReader& table, const Nominal& nominal) {
  return read_along_axes(table, nominal);
}

ValueForm deviations_form() {
  return form::words("array of 3, each 0 or above", form::array(form::number(), 3));
}

std::vector<double> read_deviations(const TableReader& table, std::string_view key, double limit,
                                    std::string_view of_limit, std::size_t count) {
  std::vector<double> deviations = table.numbers(key, count);
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    if (deviations[i] >= 0 && deviations[i] < limit) continue;
    const std::string below =
        std::isfinite(limit) ? fmt::format(" to below {:.4g}, {}", limit, of_limit) : "";
    table.fail_element(
        key, i,
        fmt::format("no standard deviation, got {}, must be from 0{}", deviations[i], below));
  }
  deviations.resize(3, 0.0);
  return deviations;
}

RelativeState in_other_frame(const TableReader& table, const Nominal& nominal,
                             const DeputySettings& deputy, RelativeFrame frame) {
  if (deputy.frame == frame) return deputy.start;
  return frame_at_chief(table, nominal, frame)
      .relative(frame_at_chief(table, nominal, deputy.frame).deviation(deputy.start));
}

}  // namespace hamjet::io
