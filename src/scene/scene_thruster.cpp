#include <fmt/format.h>

#include <cmath>

#include "scene_relative_motion.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// Standard gravity in m/s^2, by which specific impulses are told (CGPM 1901).
constexpr double standard_gravity = 9.80665;

}  // namespace

const TableDescription& thruster_table() {
  static const TableDescription table = {
      {{"acceleration_m_s2", form::positive(), absent::other("`thrust_N`"),
        "acceleration that stays the same while the thruster burns"},
       {"thrust_N", form::positive(), absent::other("`acceleration_m_s2`"),
        "thrust, beside `mass_kg` and `specific_impulse_s`: the mass falls while the thruster "
        "burns"},
       {"mass_kg", form::positive(), absent::other("refused beside `acceleration_m_s2`"),
        "mass of the spacecraft before its first burn"},
       {"specific_impulse_s", form::positive(), absent::other("refused beside `acceleration_m_s2`"),
        "speed of the exhaust over 9.80665 m/s^2"},
       {"propellant_kg", form::positive(), absent::other("as much as it takes"),
        "propellant, a part of `mass_kg`: burns that take more are not allowed"},
       {"longest_burn_s", form::positive(), absent::other("any"), "longer burns are not allowed"},
       {"shortest_burn_s", form::positive(), absent::other("any"), "shorter burns are not allowed"},
       {"attitude", form::choice({"RTN", "inertial"}), absent::value("RTN"),
        "the direction of a burn stays the same along R, T, N of the spacecraft's own orbit, or "
        "along the inertial axes"}},
      "Also burns of this thruster in place of the impulses of `[transfer]` and `[bounded.box]`, "
      "about their times. With `transfer.thrust = \"fuel-optimal\"` the transfer has its thrust of "
      "least fuel in their place: limits of burns and an attitude are then refused, and an own "
      "system has this thrust alone."};
  return table;
}

ThrusterSettings read_thruster(const TableReader& table, const Scene& scene, bool has_box) {
  table.check_keys();
  const bool is_fuel_optimal =
      scene.transfer && scene.transfer->thrust == TransferThrust::fuel_optimal;
  if (!is_orbit(scene.system.model) && !is_fuel_optimal) {
    table.fail("",
               "burns in place of impulses are of spacecraft in an orbit, must be left out, or "
               "beside transfer.thrust = \"fuel-optimal\"");
  }
  ThrusterSettings settings;
  if (table.exactly_one_of({"acceleration_m_s2", "thrust_N"}) == "thrust_N") {
    table.require({"mass_kg", "specific_impulse_s"});
    settings.mass_kg = table.positive_number("mass_kg");
    settings.acceleration_m_s2 = table.positive_number("thrust_N") / settings.mass_kg;
    settings.exhaust_m_s = table.positive_number("specific_impulse_s") * standard_gravity;
    if (!std::isfinite(settings.acceleration_m_s2) || settings.acceleration_m_s2 == 0 ||
        !std::isfinite(*settings.exhaust_m_s)) {
      table.fail("thrust_N", fmt::format("out of range, got an acceleration of {:.6g} m/s^2 and an "
                                         "exhaust of {:.6g} m/s, must be within binary64",
                                         settings.acceleration_m_s2, *settings.exhaust_m_s));
    }
  } else {
    settings.acceleration_m_s2 = table.positive_number("acceleration_m_s2");
    for (const std::string_view key : {"mass_kg", "specific_impulse_s", "propellant_kg"}) {
      if (!table.has(key)) continue;
      table.fail(key, fmt::format("not used, got {} beside acceleration_m_s2, must be beside "
                                  "thrust_N",
                                  table.found(key)));
    }
  }
  table.read_if_any("propellant_kg", settings.propellant_kg);
  if (settings.propellant_kg && *settings.propellant_kg >= settings.mass_kg) {
    table.fail("propellant_kg", fmt::format("as much as the whole spacecraft, got {}, must be less "
                                            "than mass_kg = {:.6g}",
                                            *settings.propellant_kg, settings.mass_kg));
  }
  table.read_if_any("longest_burn_s", settings.longest_burn_s);
  table.read_if_any("shortest_burn_s", settings.shortest_burn_s);
  if (settings.longest_burn_s && settings.shortest_burn_s &&
      *settings.longest_burn_s < *settings.shortest_burn_s) {
    table.fail("longest_burn_s", fmt::format("below shortest_burn_s = {:.6g}, got {:.6g}, must be "
                                             "at least this",
                                             *settings.shortest_burn_s, *settings.longest_burn_s));
  }
  table.read_if_any("attitude", settings.attitude);
  if (!scene.transfer && !has_box) {
    table.fail("",
               "of no use without impulses, got no table [transfer] or [bounded.box], must be "
               "beside one");
  }
  if (scene.transfer && scene.transfer->times.back() < 0) {
    table.fail("",
               fmt::format("transfer times before the start, got {:.6g} s, must be after it with "
                           "a thruster",
                           scene.transfer->times.back() * scene.units.time_s));
  }
  return settings;
}

}  // namespace hamjet::io
