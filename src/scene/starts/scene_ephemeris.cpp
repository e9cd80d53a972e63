#include <fmt/format.h>

#include <algorithm>

#include "../../dynamics/celestial_bodies.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "hamjet/formats/orbit_message.hpp"

namespace hamjet::io {
namespace {

using std::chrono::sys_days;
using std::chrono::year;

/// Before this day the second of UTC had other lengths.
constexpr sys_days first_day_of_utc = sys_days(year(1972) / 1 / 1);

/// A text that an orbit message can hold.
std::string message_text(const TableReader& ephemeris, std::string_view key) {
  constexpr std::size_t longest = 80;
  const std::string text = ephemeris.text(key);
  const bool is_printable =
      std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
  const bool is_bare = !text.empty() && text.front() != ' ' && text.back() != ' ';
  if (!is_printable || !is_bare || text.size() > longest) {
    ephemeris.fail(key, fmt::format("no text of an orbit message, got {}, must be 1 to {} "
                                    "characters of ASCII without blanks at the ends",
                                    in_quotes(text), longest));
  }
  return text;
}

std::string read_frame(const TableReader& ephemeris) {
  const std::string frame = message_text(ephemeris, "reference_frame");
  if (!is_inertial_frame(frame)) ephemeris.fail("reference_frame", frame_problem(frame));
  return frame;
}

/// Refuses the name of a body whose gravitational parameter is not that of the scene's centre.
void require_centre(const TableReader& ephemeris, const std::string& name,
                    const SystemSettings& system) {
  const CelestialBody* const body = body_named(name);
  const bool is_other = body != nullptr && body != body_with_mu(system.mu_km3_s2);
  if (!is_orbit(system.model) || !is_other) return;
  ephemeris.fail("center_name",
                 fmt::format("another centre than the scene's, got {} and system.mu_km3_s2 = {}, "
                             "must be the name of a body with that mu, or mu near {:.8g}",
                             in_quotes(name), system.mu_km3_s2, body->mu_km3_s2));
}

/// Refuses a value that differs from that of the nominal's file, which the scene may only repeat.
void require_same(const TableReader& ephemeris, std::string_view key, const std::string& given,
                  const std::string& of_file) {
  if (given == of_file) return;
  ephemeris.fail(key, fmt::format("not that of the nominal's file, got {}, must be {} or left out",
                                  in_quotes(given), in_quotes(of_file)));
}

}  // namespace

Epoch read_epoch(const TableReader& table, std::string_view key) {
  const std::string text = table.text(key);
  const auto epoch = parse_epoch(text);
  // The seconds of Thh:mm:60.
  const std::size_t second = text.find(":60", text.find('T') + 6);
  std::string before = text;
  if (second != std::string::npos) before.replace(second, 3, ":59");
  if (!epoch && parse_epoch(before)) {
    table.fail(key, fmt::format("no leap second then, got {}, must be another second: UTC had {}, "
                                "the last one at the end of {}",
                                in_quotes(text), days_with_leap_second().size(),
                                format_epoch({days_with_leap_second().back(), 0}).substr(0, 10)));
  }
  if (!epoch) {
    table.fail(key, fmt::format("no moment of the calendar, got {}, must be "
                                "YYYY-MM-DDThh:mm:ss or YYYY-DDDThh:mm:ss, with a fraction "
                                "of a second if wanted",
                                in_quotes(text)));
  }
  return *epoch;
}

void require_leap_second(const TableReader& table, std::string_view key, const Epoch& epoch,
                         TimeSystem system) {
  if (system == TimeSystem::utc || !epoch.is_within_leap_second()) return;
  table.fail(key, fmt::format("a leap second, which UTC alone has, got {} {}, must be another "
                              "second, or a date in UTC",
                              format_epoch(epoch), time_system_name(system)));
}

ValueForm form_of_epoch() {
  return form::words("`\"YYYY-MM-DDThh:mm:ss\"` or `\"YYYY-DDDThh:mm:ss\"`");
}

std::optional<Epoch> epoch_of_start(const TableReader& root) {
  if (root.has("ephemeris") && root.table("ephemeris").has("epoch")) {
    return read_epoch(root.table("ephemeris"), "epoch");
  }
  return root.has("nominal") ? epoch_of_nominal_file(root.table("nominal")) : std::nullopt;
}

const TableDescription& ephemeris_table() {
  static const EphemerisSettings preset;
  const auto of_file = absent::other("required, or of the nominal's file");
  const auto epoch = form_of_epoch();
  const auto text = form::words("1 to 80 characters of ASCII");
  static const TableDescription table = {
      {{"epoch", epoch, of_file, "epoch of the nominal's start, in the time system"},
       {"time_system", form::choice(time_system_names()), of_file, "time system of all epochs"},
       {"reference_frame", text, of_file,
        "inertial, with the z axis along the axis of the zonal field"},
       {"reference_frame_epoch", epoch,
        absent::other("required by a frame that ends with `OFEPOCH`"), "epoch of the frame"},
       {"center_name", text, of_file, "the centre of attraction, for example `EARTH`"},
       {"object_name", text, absent::value(preset.object_name), "name of the nominal's object"},
       {"object_id", text, absent::value(preset.object_id),
        "international designator of that object"},
       {"deputy_name", text, absent::value(preset.deputy_name),
        "name of the spacecraft that flies relative to the nominal"},
       {"deputy_id", text, absent::value(preset.deputy_id),
        "international designator of that spacecraft"},
       {"originator", text, absent::value(preset.originator), "who made the message"},
       {"oem_version", form::words("2.0 or 3.0", form::number()), absent::other("2.0"),
        "version of the messages that are written"}},
      "What the nominal's file says need not be said again, and cannot be changed."};
  return table;
}

EphemerisSettings read_ephemeris(const TableReader& ephemeris,
                                 const std::optional<EphemerisSettings>& known,
                                 const SystemSettings& system) {
  ephemeris.check_keys();
  EphemerisSettings settings;
  if (known) settings = *known;
  const EphemerisSettings of_file = settings;
  const auto read = [&](std::string_view key, std::string& value, const auto& read_value,
                        const std::string& right) {
    if (!ephemeris.has(key) && known) return;
    value = read_value();
    if (known) require_same(ephemeris, key, value, right);
  };
  read(
      "epoch", settings.epoch, [&] { return format_epoch(read_epoch(ephemeris, "epoch")); },
      of_file.epoch);
  read(
      "time_system", settings.time_system,
      [&] { return std::string(time_system_names()[ephemeris.choice("time_system")]); },
      of_file.time_system);
  if (ephemeris.has("epoch")) {
    require_leap_second(ephemeris, "epoch", parse_epoch(settings.epoch).value(),
                        time_system_named(settings.time_system).value());
  }
  if (!known) {
    settings.reference_frame = read_frame(ephemeris);
  } else if (ephemeris.has("reference_frame")) {
    const std::string frame = read_frame(ephemeris);
    // Another name of the same axes is not a contradiction.
    if (name_of_axes(frame) != name_of_axes(of_file.reference_frame)) {
      require_same(ephemeris, "reference_frame", frame, of_file.reference_frame);
    }
  }
  if (ephemeris.has("reference_frame_epoch")) {
    settings.reference_frame_epoch = format_epoch(read_epoch(ephemeris, "reference_frame_epoch"));
    if (known) {
      require_same(ephemeris, "reference_frame_epoch", settings.reference_frame_epoch,
                   of_file.reference_frame_epoch);
    }
  } else if (!known && settings.reference_frame.ends_with("OFEPOCH")) {
    ephemeris.fail("reference_frame_epoch",
                   fmt::format("missing, must be the epoch of the frame {}, ISO 8601",
                               settings.reference_frame));
  }
  read(
      "center_name", settings.center_name, [&] { return message_text(ephemeris, "center_name"); },
      of_file.center_name);
  // A nominal from a file has already been compared with the scene's centre.
  if (!known) require_centre(ephemeris, settings.center_name, system);
  const auto rename = [&](std::string_view key, std::string& value) {
    if (ephemeris.has(key)) value = message_text(ephemeris, key);
  };
  rename("object_name", settings.object_name);
  rename("object_id", settings.object_id);
  rename("deputy_name", settings.deputy_name);
  rename("deputy_id", settings.deputy_id);
  rename("originator", settings.originator);
  if (ephemeris.has("oem_version")) {
    const double version = ephemeris.number("oem_version");
    if (version != 2 && version != 3) {
      ephemeris.fail("oem_version",
                     fmt::format("unknown version, got {}, must be 2.0 or 3.0", version));
    }
    settings.oem_version = version == 2 ? "2.0" : "3.0";
  }
  return settings;
}

void require_calendar(const TableReader& table, std::string_view key, const Scene& scene) {
  const EphemerisSettings& settings = *scene.ephemeris;
  const Epoch start = parse_epoch(settings.epoch).value();
  const bool is_utc = settings.time_system == "UTC";
  constexpr std::string_view others =
      "must be in TAI, TT, GPS or TDB, whose days all have 86400 seconds, or another one";
  const auto fail = [&](const std::string& problem) {
    table.fail(key, fmt::format("{}, {}", problem, others));
  };
  if (is_utc && start.day < first_day_of_utc) {
    fail(fmt::format("before 1972, when the second of UTC had another length, got {}",
                     settings.epoch));
  }
  if (format_epoch(start).find(":60.") != std::string::npos) {
    fail(fmt::format("within a leap second, got {}", settings.epoch));
  }
  std::vector<double> times = {scene.duration};
  if (scene.transfer) times.push_back(scene.transfer->times.back());
  for (const double time : times) {
    const Extended seconds = Extended(time) * scene.units.time_s;
    const auto end = later(start, seconds);
    if (!end) {
      table.fail(key, fmt::format("a span that leaves the calendar, got {} and {:.6g} s, must "
                                  "stay within the years 1 to 9999",
                                  settings.epoch, convert<double>(seconds)));
    }
    const auto leap = is_utc ? leap_second_between(start, *end) : std::nullopt;
    if (leap) {
      fail(fmt::format("a span across the leap second at the end of {}, got {} to {}",
                       format_epoch({*leap, 0}).substr(0, 10), settings.epoch, format_epoch(*end)));
    }
  }
}

}  // namespace hamjet::io
