#include "scene_earth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../../dynamics/fields/spherical_harmonic_field.hpp"
#include "../../store/sealed_summary.hpp"
#include "../../store/text_file.hpp"
#include "../../studies/flown_span.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/earth_orientation_file.hpp"
#include "scene_earth_field.hpp"

namespace hamjet::io {
namespace {

struct EpochKey {
  std::string_view name;
  TimeSystem system;
};
constexpr std::array<EpochKey, 4> epoch_key_names = {{{"epoch_utc", TimeSystem::utc},
                                                      {"epoch_tt", TimeSystem::tt},
                                                      {"epoch_tai", TimeSystem::tai},
                                                      {"epoch_gps", TimeSystem::gps}}};
constexpr std::string_view right_epoch =
    "must be one of epoch_utc, epoch_tt, epoch_tai and epoch_gps, for the Earth turns by 465 m a "
    "second at its equator";

/// The axes that a scene may name; TEME is that of two-line elements, which are no orbits here.
const std::vector<std::string_view> axes_names = {"GCRF", "EME2000", "MOD", "TOD", "ITRF"};

constexpr double mu_margin = 0.01;

std::vector<std::string_view> given_epochs(const TableReader& nominal) {
  std::vector<std::string_view> given;
  for (const EpochKey& key : epoch_key_names) {
    if (nominal.has(key.name)) given.push_back(key.name);
  }
  return given;
}

/// The date at which the nominal stands, and the key that says it: that of the nominal's epoch, of
/// its message, or of [ephemeris].
struct Date {
  Epoch epoch;
  TimeSystem system;
  TableReader table;
  std::string_view key;
};

/// The dates at which the Earth's axes, the Sun and the Moon are known: UTC began in 1960, and the
/// series of the Sun (ERFA's eraEpv00) are fitted from 1900 to 2100.
constexpr std::chrono::sys_days first_known_day = std::chrono::year(1960) / 1 / 1;
constexpr std::chrono::sys_days last_known_day = std::chrono::year(2099) / 12 / 31;
constexpr std::string_view right_dates = "must be from 1960-01-01 to 2099-12-31";

Date read_date(const TableReader& root) {
  const TableReader nominal = root.table("nominal");
  const auto given = given_epochs(nominal);
  const auto of_file = settings_of_orbit_file(nominal);
  if (given.size() > 1) {
    nominal.fail(given[1],
                 fmt::format("a second epoch, got {} and {}, {}", given[0], given[1], right_epoch));
  }
  if (of_file) {
    if (!given.empty()) {
      nominal.fail(given[0], fmt::format("the message has its own epoch, got {}, must be left out",
                                         nominal.found(given[0])));
    }
    return {parse_epoch(of_file->epoch).value(), time_system_named(of_file->time_system).value(),
            nominal, nominal.exactly_one_of({"oem_file", "opm_file"})};
  }
  if (!given.empty()) {
    const auto key = std::find_if(epoch_key_names.begin(), epoch_key_names.end(),
                                  [&](const EpochKey& one) { return one.name == given[0]; });
    return {read_epoch(nominal, key->name), key->system, nominal, key->name};
  }
  if (nominal.has("epoch")) {
    nominal.fail("epoch", fmt::format("without a time system, got {}, {}", nominal.found("epoch"),
                                      right_epoch));
  }
  if (root.has("ephemeris") && root.table("ephemeris").has("epoch") &&
      root.table("ephemeris").has("time_system")) {
    const TableReader ephemeris = root.table("ephemeris");
    return {read_epoch(ephemeris, "epoch"),
            static_cast<TimeSystem>(ephemeris.choice("time_system")), ephemeris, "epoch"};
  }
  nominal.fail(
      "", fmt::format("no epoch, got a scene of the model earth without one, {}", right_epoch));
}

/// The moment of a date, which must be one at which the Earth's axes are known.
Instant instant_of_date(const Date& date) {
  const std::string_view name = time_system_name(date.system);
  const std::string got = fmt::format("got {} {}", format_epoch(date.epoch), name);
  require_leap_second(date.table, date.key, date.epoch, date.system);
  const auto day = date.epoch.day;
  if (day < first_known_day || day > last_known_day) {
    date.table.fail(date.key,
                    fmt::format("a date at which the Earth's axes or the Sun are not known, {}, {}",
                                got, right_dates));
  }
  const Instant instant = instant_of(date.epoch, date.system);
  if (instant < instant_of({first_known_day, 0}, TimeSystem::utc)) {
    date.table.fail(date.key, fmt::format("before UTC began, {}, {} in UTC", got, right_dates));
  }
  return instant;
}

/// The moment at which the axes of a message lie: that of the frame, or of the state.
Instant axes_moment(const EphemerisSettings& message) {
  const bool is_fixed = !message.reference_frame_epoch.empty();
  return instant_of(parse_epoch(is_fixed ? message.reference_frame_epoch : message.epoch).value(),
                    time_system_named(message.time_system).value());
}

/// Refuses a table of the Earth's orientation that ends before the scene's flights, or begins
/// after them.
void require_orientation(const TableReader& root, const EarthSettings& earth) {
  if (!earth.orientation) return;
  const Instant epoch{parse_epoch(earth.epoch_tt).value()};
  try {
    earth.orientation->between(later(epoch, earth.first_s), later(epoch, earth.last_s), 0);
  } catch (const Error& error) {
    root.table("system").fail("orientation_file", error.what());
  }
}

void read_orientation(const TableReader& system, EarthSettings& earth) {
  if (!system.has("orientation_file")) return;
  earth.orientation_file = system.text("orientation_file");
  const std::string text =
      system.content_beside_scene("orientation_file", largest_earth_orientation_bytes);
  earth.orientation_checksum = fmt::format("{:08x}", record_of({}, text).crc32);
  earth.orientation = std::make_shared<const EarthOrientation>(
      read_earth_orientation(printable_path(system.path_beside_scene("orientation_file")), text));
}

}  // namespace

std::vector<SceneKey> earth_keys() {
  const std::vector<std::string_view> owner = {"earth"};
  const EarthSettings preset;
  return {
      {"gravity_degree", form::integer(2, SphericalHarmonicField::highest_degree),
       absent::value(preset.degree), "the highest degree of the harmonics of the Earth's field",
       owner},
      {"gravity_order", form::integer(0, SphericalHarmonicField::highest_degree),
       absent::other("`gravity_degree`"),
       "the highest order of the harmonics; with 0 only zonal ones are left", owner},
      {"sun", form::boolean(), absent::value(preset.has_sun), "whether this body attracts", owner},
      {"moon", form::boolean(), absent::value(preset.has_moon), "whether this body attracts",
       owner},
      {"mu_sun_km3_s2", form::positive(), absent::value(preset.mu_sun_km3_s2),
       "gravitational parameter of the Sun", owner},
      {"mu_moon_km3_s2", form::positive(), absent::value(preset.mu_moon_km3_s2),
       "gravitational parameter of the Moon", owner},
      {"orientation_file", form::text(), absent::other("UT1 = UTC, no polar motion"),
       "finals2000A of the IERS, relative to the scene's folder", owner}};
}

std::vector<SceneKey> epoch_keys() {
  std::vector<SceneKey> keys;
  for (const EpochKey& key : epoch_key_names) {
    keys.push_back({key.name,
                    form_of_epoch(),
                    absent::other("another one, for the model earth"),
                    "epoch of the start",
                    {orbits}});
  }
  keys.push_back({"axes",
                  form::choice(axes_names),
                  absent::other("`\"GCRF\"`, or those of the message"),
                  "axes in which orbits of the model earth are given, and messages are written",
                  {orbits}});
  return keys;
}

void refuse_epoch_keys(const TableReader& nominal, const SystemSettings& system) {
  if (system.earth) return;
  std::vector<std::string_view> keys = given_epochs(nominal);
  if (nominal.has("axes")) keys.emplace_back("axes");
  if (keys.empty()) return;
  nominal.fail(keys[0],
               fmt::format("of no use to the model {}, whose axes are those of its field at all "
                           "times, got {}, must be left out, or system.model = \"earth\"",
                           model_name(system.model), nominal.found(keys[0])));
}

void read_earth(const TableReader& root, SystemSettings& settings) {
  const TableReader system = root.table("system");
  EarthSettings earth;
  const Date date = read_date(root);
  earth.epoch_tt = format_epoch(instant_of_date(date).tt);
  if (date.system == TimeSystem::utc) {
    if (const auto doubt = doubt_of_utc(date.epoch)) date.table.warn(date.key, *doubt);
  }
  if (system.has("gravity_degree"))
    earth.degree = static_cast<int>(system.integer("gravity_degree"));
  earth.order = earth.degree;
  if (system.has("gravity_order")) {
    earth.order = static_cast<int>(system.integer("gravity_order"));
    if (earth.order > earth.degree) {
      system.fail("gravity_order",
                  fmt::format("above the degree, got {} and gravity_degree = {}, must be at most "
                              "the degree",
                              earth.order, earth.degree));
    }
  }
  read_earth_field(system, date.epoch, settings, earth);
  system.read_if_any("sun", earth.has_sun);
  system.read_if_any("moon", earth.has_moon);
  const auto read_mu = [&](std::string_view key, double& mu, bool acts) {
    if (!system.has(key)) return;
    if (!acts) {
      system.fail(key, fmt::format("the body does not attract, got {}, must be left out",
                                   system.found(key)));
    }
    const double usual = mu;
    mu = system.positive_number(key);
    if (std::abs(mu / usual - 1) > mu_margin) {
      system.warn(key,
                  fmt::format("another body's mu, got {}, should be near {} km^3/s^2", mu, usual));
    }
  };
  read_mu("mu_sun_km3_s2", earth.mu_sun_km3_s2, earth.has_sun);
  read_mu("mu_moon_km3_s2", earth.mu_moon_km3_s2, earth.has_moon);
  read_orientation(system, earth);
  require_orientation(root, earth);
  const TableReader nominal = root.table("nominal");
  if (nominal.has("axes")) {
    earth.axes = axes_names[nominal.choice("axes")];
  } else if (const auto message = settings_of_orbit_file(nominal);
             message && message->reference_frame_epoch.empty()) {
    earth.axes = message->reference_frame;
  }
  settings.earth = std::move(earth);
}

CartesianState in_gcrf(const TableReader& table, const CartesianState& state,
                       const std::optional<NominalFile>& file, const EarthSettings& earth) {
  const std::string name = file ? file->ephemeris.reference_frame : earth.axes;
  const auto axes = axes_named(name);
  // Keys of a scene have been compared with the names of axes; a message has more of them.
  const std::string_view key = file ? table.exactly_one_of({"oem_file", "opm_file"}) : "axes";
  if (!axes) {
    table.fail(key, fmt::format("axes that are not known beside those of the Earth, got {}, must "
                                "be one of: {}",
                                in_quotes(name), listed(axes_names)));
  }
  if (*axes == EarthAxes::gcrf) return state;
  Instant moment{parse_epoch(earth.epoch_tt).value()};
  if (file) moment = axes_moment(file->ephemeris);
  const AxesChange change = [&] {
    try {
      return axes_change(*axes, EarthAxes::gcrf, moment, earth.orientation);
    } catch (const Error& error) {
      table.fail(key, error.what());
    }
  }();
  CartesianState result = state;
  Eigen::Map<Vector<Extended>> position(result.position_km.data(), 3);
  Eigen::Map<Vector<Extended>> velocity(result.velocity_km_s.data(), 3);
  change.apply(position, velocity);
  return result;
}

bool is_at_start(const EarthSettings& earth, const Epoch& epoch, std::string_view time_system) {
  // Times of TDB are rounded to this when they are converted to TT.
  constexpr double rounding_s = 1e-9;
  const Instant start{parse_epoch(earth.epoch_tt).value()};
  const TimeSystem system = time_system_named(time_system).value();
  if (system == TimeSystem::utc && epoch.day < first_known_day) return false;
  const Instant moment = instant_of(epoch, system);
  return abs(seconds_between(start, moment)) < rounding_s;
}

EphemerisSettings ephemeris_of_earth(const TableReader& root) {
  const Date date = read_date(root);
  EphemerisSettings settings =
      settings_of_orbit_file(root.table("nominal")).value_or(EphemerisSettings());
  settings.reference_frame_epoch.clear();
  settings.epoch = format_epoch(date.epoch);
  settings.time_system = time_system_name(date.system);
  settings.reference_frame = "GCRF";
  settings.center_name = "EARTH";
  return settings;
}

void refuse_fixed_flows(const TableReader& root, const Scene& scene) {
  if (!scene.system.earth) return;
  constexpr std::string_view why =
      "needs a flow that is the same at every start, and the forces of the model earth depend on "
      "the time";
  constexpr std::string_view other_model =
      "or system.model = \"zonal-gravity\" with the field's zonal harmonics";
  const TableReader jet = root.table("jet");
  if (has_time_shift(scene.symmetry)) {
    jet.fail("symmetry", fmt::format("{}, got \"rotation-and-time\", must be \"rotation\" or "
                                     "\"none\", {}",
                                     why, other_model));
  }
  for (const std::string_view study : {"bounded", "event"}) {
    if (!root.has(study)) continue;
    root.table(study).fail(
        "", fmt::format("{}, got the table [{}], must be left out, {}", why, study, other_model));
  }
}

void set_span_of_earth(const TableReader& root, Scene& scene) {
  if (!scene.system.earth) return;
  const FlownSpan span = flown_span(scene);
  EarthSettings& earth = *scene.system.earth;
  earth.first_s = span.first * scene.units.time_s;
  earth.last_s = span.last * scene.units.time_s;
  const Date date = read_date(root);
  const Instant epoch{parse_epoch(earth.epoch_tt).value()};
  const auto seconds_to = [&](std::chrono::sys_days day) {
    return convert<double>(seconds_between(epoch, {Epoch{day, 0}}));
  };
  const bool is_before = earth.first_s < seconds_to(first_known_day);
  if (is_before || earth.last_s > seconds_to(last_known_day + std::chrono::days(1))) {
    const double beyond = is_before ? earth.first_s : earth.last_s;
    date.table.fail(
        date.key,
        fmt::format("flights that leave the dates at which the Earth's axes and the Sun are known, "
                    "got {} and {:.6g} s from it, {}",
                    format_epoch(date.epoch), beyond, right_dates));
  }
  require_orientation(root, earth);
}

}  // namespace hamjet::io
