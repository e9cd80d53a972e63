#include "scene_manoeuvres.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../../store/text_file.hpp"
#include "../../studies/formation/burns/canonical_thruster.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/astronomy/instant.hpp"
#include "hamjet/error.hpp"
#include "scene_nominal_file.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view manoeuvre_file_key = "opm_file";
constexpr std::string_view manoeuvre_choice_key = "manoeuvres";

/// In canonical units, a hundredth of a second in a low orbit.
constexpr double shortest_burn = 1e-5;

enum class MessageManoeuvres { fly, leave_out };

/// Reads the manoeuvres of one message.
class MessageManoeuvreReader {
 public:
  MessageManoeuvreReader(const TableReader& table, const SystemSettings& system,
                         const CanonicalScale& scale, OrbitParameterMessage message)
      : table_(table),
        system_(system),
        scale_(scale),
        message_(std::move(message)),
        mass_kg_(message_.spacecraft.mass_kg) {}

  std::vector<Manoeuvre> read() {
    std::vector<Manoeuvre> result;
    for (const OpmManoeuvre& told : message_.manoeuvres) {
      Manoeuvre one;
      const double start_s = seconds_from_epoch(told);
      one.start = scale_.time_of_s(start_s);
      one.length = scale_.time_of_s(told.duration_s);
      if (start_s < 0) fail(told, "before EPOCH", "at or after the moment of the state");
      if (!result.empty() && one.start < result.back().end()) {
        fail(told, "before the manoeuvre above it ends", "behind it");
      }
      set_change(told, one);
      one.mass_share = share_of_mass(told);
      if (one.length < shortest_burn) become_impulse(one);
      result.push_back(one);
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const OpmManoeuvre& told, std::string_view got,
                         std::string_view right) const {
    table_.fail(manoeuvre_file_key,
                fmt::format("a manoeuvre that cannot be flown, got one {} in {}:{}, must "
                            "be {}",
                            got, printable_path(table_.path_beside_scene(manoeuvre_file_key)),
                            told.line, right));
  }

  double seconds_from_epoch(const OpmManoeuvre& told) const {
    const TimeSystem clock = message_.metadata.time_system;
    const Epoch& epoch = message_.state.epoch;
    if (system_.earth) {
      return convert<double>(
          seconds_between(instant_of(epoch, clock), instant_of(told.ignition, clock)));
    }
    if (clock == TimeSystem::utc && epoch < told.ignition &&
        leap_second_between(epoch, told.ignition)) {
      fail(told, "across a leap second of UTC",
           "in another time system, or beside the model \"earth\", which knows them");
    }
    return seconds_between(epoch, told.ignition);
  }

  void set_change(const OpmManoeuvre& told, Manoeuvre& one) const {
    for (std::size_t i = 0; i < 3; ++i) {
      one.change[static_cast<Eigen::Index>(i)] =
          convert<double>(told.change_km_s[i] * scale_.time_s / scale_.length_km);
    }
    const std::string& frame = told.reference_frame;
    if (frame == "RTN" || frame == "RSW") {
      one.axes = ThrustAxes::rtn;
    } else if (frame == "TNW") {
      one.axes = ThrustAxes::tnw;
    } else if (system_.earth) {
      const auto axes = axes_named(frame);
      if (!axes) {
        fail(told, "along " + frame, "along axes that are known about the Earth, or RTN or TNW");
      }
      const Instant moment = instant_of(told.ignition, message_.metadata.time_system);
      one.change =
          axes_change(*axes, EarthAxes::gcrf, moment, system_.earth->orientation).rotation *
          one.change;
    } else if (name_of_axes(frame) != name_of_axes(message_.metadata.reference_frame)) {
      fail(told, "along " + frame,
           fmt::format("along the axes of the state, {}, or RTN or TNW",
                       message_.metadata.reference_frame));
    }
  }

  /// An impulse at the mean time of the thrust. Of what a burn of length T does it misses n^2 T^2 /
  /// 24, which is below rounding; its own flight would not resolve T beside the time of the clock.
  static void become_impulse(Manoeuvre& one) {
    const double s = one.mass_share;
    one.start += one.length * (s > 0 ? mean_share(-std::log1p(-s)) / s : 0.5);
    one.length = 0;
  }

  double share_of_mass(const OpmManoeuvre& told) {
    if (told.mass_change_kg == 0) return 0;
    if (!mass_kg_) {
      if (told.duration_s == 0) return 0;
      fail(told, "that takes mass of a spacecraft without MASS", "beside MASS");
    }
    const double left = *mass_kg_ + told.mass_change_kg;
    if (!(left > 0)) {
      fail(told, fmt::format("that takes {:.6g} of {:.6g} kg", -told.mass_change_kg, *mass_kg_),
           "of less than the mass that is there");
    }
    const double share = -told.mass_change_kg / *mass_kg_;
    mass_kg_ = left;
    return share;
  }

  const TableReader& table_;
  const SystemSettings& system_;
  const CanonicalScale& scale_;
  OrbitParameterMessage message_;
  std::optional<double> mass_kg_;  ///< before the next manoeuvre
};

}  // namespace

SceneKey manoeuvres_key(const std::vector<std::string_view>& owners) {
  return {manoeuvre_choice_key, form::choice({"fly", "leave-out"}), absent::value("fly"),
          "of the message in `opm_file`: `hamjet motion` flies them, other commands refuse them; "
          "leave-out: the orbit coasts",
          owners};
}

std::vector<Manoeuvre> read_manoeuvres(const TableReader& table, const SystemSettings& system,
                                       const CanonicalScale& scale) {
  MessageManoeuvres choice = MessageManoeuvres::fly;
  table.read_if_any(manoeuvre_choice_key, choice);
  if (!table.has(manoeuvre_file_key)) {
    if (table.has(manoeuvre_choice_key)) {
      table.fail(manoeuvre_choice_key,
                 fmt::format("not used, got {} without an opm_file, must be beside one",
                             table.found(manoeuvre_choice_key)));
    }
    return {};
  }
  if (choice == MessageManoeuvres::leave_out) return {};
  return MessageManoeuvreReader(table, system, scale, parameters_of_orbit_file(table)).read();
}

void refuse_manoeuvres(const TableReader& table) {
  if (!table.has(manoeuvre_file_key)) return;
  MessageManoeuvres choice = MessageManoeuvres::fly;
  table.read_if_any(manoeuvre_choice_key, choice);
  const OrbitParameterMessage message = parameters_of_orbit_file(table);
  if (choice == MessageManoeuvres::leave_out || message.manoeuvres.empty()) return;
  table.fail(manoeuvre_file_key,
             fmt::format("a message with {} manoeuvres, got the first in line {}, must be "
                         "without, or beside manoeuvres = \"leave-out\": velocity changes "
                         "are what this study finds",
                         message.manoeuvres.size(), message.manoeuvres.front().line));
}

}  // namespace hamjet::io
