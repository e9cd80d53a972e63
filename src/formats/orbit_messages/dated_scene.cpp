#include "dated_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "hamjet/astronomy/earth_orientation.hpp"
#include "hamjet/astronomy/instant.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"

namespace hamjet::io {
namespace {

/// A text for orbit messages, which must be printable ASCII; other characters become question
/// marks.
std::string ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return text;
}

std::string earth_text(const SystemSettings& system) {
  const EarthSettings& earth = *system.earth;
  return fmt::format(
      "Model: {}, GM = {} km**3/s**2, radius {} km, {} to {} x {}{}{}; {}, {}, no tides, "
      "no relativity",
      model_name(system.model), system.mu_km3_s2, system.radius_km,
      system.gravity_file->model_name.empty() ? "the field" : system.gravity_file->model_name,
      earth.degree, earth.order, earth.has_sun ? ", Sun" : "", earth.has_moon ? ", Moon" : "",
      earth.atmosphere ? fmt::format("drag of C_D A/m = {} m**2/kg, density {}", earth.drag_m2_kg,
                                     name_of(earth.atmosphere->model))
                       : "no drag",
      earth.radiation ? fmt::format("radiation pressure of C_R A/m = {} m**2/kg, shadow {}",
                                    earth.radiation_m2_kg, name_of(earth.radiation->shadow))
                      : "no radiation pressure");
}

std::string model_text(const SystemSettings& system) {
  std::string text =
      fmt::format("Model: {}, GM = {} km**3/s**2", model_name(system.model), system.mu_km3_s2);
  if (system.J.any()) text += fmt::format(", radius {} km", system.radius_km);
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    if (system.J[n] != 0) text += fmt::format(", J{} = {}", n, system.J[n]);
  }
  return text + "; no drag, no other bodies";
}

}  // namespace

TimeSystem time_system_of(const EphemerisSettings& settings) {
  return time_system_named(settings.time_system).value();
}

Epoch current_epoch() {
  const auto moment = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const auto day = std::chrono::floor<std::chrono::days>(moment);
  return {day, (moment - day).count() * picoseconds_per_second};
}

std::vector<std::string> origin_comments(const Scene& scene, const std::string& source) {
  return {
      ascii(fmt::format("Written by hamjet {}, scene {}: {}", version, scene.name, scene.title)),
      ascii(source)};
}

std::vector<std::string> model_comments(const Scene& scene) {
  const EphemerisSettings& settings = *scene.ephemeris;
  if (const auto& earth = scene.system.earth) {
    return {ascii(earth_text(scene.system)),
            earth->orientation
                ? ascii("The Earth's orientation: IAU 2006/2000A and " + earth->orientation_file)
                : EarthOrientation::without_table()};
  }
  return {model_text(scene.system),
          fmt::format(
              "The axes of {} are taken as inertial{}", settings.reference_frame,
              scene.system.J.any()
                  ? ", its z axis as that of the zonal field: true of TOD; of EME2000, GCRF and "
                    "ICRF the nearer their poles are to the body's"
                  : ""),
          fmt::format(
              "Times: {} {} and the seconds of the motion, every day with 86400{}", settings.epoch,
              settings.time_system,
              settings.time_system == "UTC"
                  ? "; no leap second is known in this span (the last one known here is that at "
                    "the end of 2016-12-31)"
                  : "")};
}

Epoch moment_of(const Scene& scene, double time) {
  const EphemerisSettings& settings = *scene.ephemeris;
  const Epoch start = parse_epoch(settings.epoch).value();
  const Extended seconds = Extended(time) * scene.units.time_s;
  if (scene.system.earth) {
    const Instant first{parse_epoch(scene.system.earth->epoch_tt).value()};
    return epoch_of(later(first, seconds), time_system_of(settings));
  }
  const auto epoch = later(start, seconds);
  const bool is_dated =
      epoch && !(settings.time_system == "UTC" && leap_second_between(start, *epoch));
  if (!is_dated) {
    throw Error(ErrorKind::input_output,
                fmt::format("ephemeris.epoch: {} {} and {:.6g} s are no moment that is known, must "
                            "not be across a leap second nor outside of the years 1 to 9999",
                            settings.epoch, settings.time_system, convert<double>(seconds)));
  }
  return *epoch;
}

}  // namespace hamjet::io
