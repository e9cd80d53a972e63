#include "scene_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "../systems/scene_earth.hpp"
#include "hamjet/astronomy/earth_axes.hpp"
#include "scene_elements.hpp"
#include "scene_manoeuvres.hpp"

namespace hamjet::io {
namespace {

const std::vector<std::string_view> cartesian_keys = {"position_km", "velocity_km_s"};
const std::vector<std::string_view> file_keys = {"oem_file", "opm_file", "epoch", "object",
                                                 "manoeuvres"};

const std::vector<std::string_view>& names_of_elements() {
  static const std::vector<std::string_view> names = TableDescription{element_keys()}.names();
  return names;
}

std::optional<std::string_view> any_of(const TableReader& table,
                                       const std::vector<std::string_view>& keys) {
  const auto given =
      std::find_if(keys.begin(), keys.end(), [&](std::string_view key) { return table.has(key); });
  return given != keys.end() ? std::optional(*given) : std::nullopt;
}

CartesianState read_position_and_velocity(const TableReader& table) {
  table.require(cartesian_keys);
  CartesianState state;
  const std::vector<double> position = table.numbers("position_km", 3);
  const std::vector<double> velocity = table.numbers("velocity_km_s", 3);
  std::copy(position.begin(), position.end(), state.position_km.begin());
  std::copy(velocity.begin(), velocity.end(), state.velocity_km_s.begin());
  if (std::all_of(position.begin(), position.end(), [](double x) { return x == 0; })) {
    table.fail("position_km",
               "at the centre of attraction, got [0, 0, 0], must be any other point");
  }
  return state;
}

}  // namespace

std::vector<SceneKey> orbit_keys(const std::vector<std::string_view>& owners) {
  const auto other_form = absent::other("another form");
  return joined<SceneKey>(
      {{{"position_km", form::array(form::number(), 3), other_form, "x, y, z from the centre",
         owners},
        {"velocity_km_s", form::array(form::number(), 3), other_form,
         "velocity along the same axes", owners}},
       element_keys(owners),
       {{"oem_file", form::text(), other_form, "an orbit ephemeris message of CCSDS", owners},
        {"opm_file", form::text(), other_form, "an orbit parameter message of CCSDS", owners},
        {"epoch", form_of_epoch(), absent::other("the first of the file"),
         "epoch of the state to take; nothing is interpolated", owners},
        {"object", form::text(), absent::other("the only one of the file"),
         "name or identifier of the object to take", owners},
        manoeuvres_key(owners)}});
}

std::optional<std::string_view> orbit_key_of(const TableReader& table) {
  for (const auto* keys : {&cartesian_keys, &names_of_elements(), &file_keys}) {
    if (const auto key = any_of(table, *keys)) return key;
  }
  return std::nullopt;
}

Orbit read_orbit(const TableReader& table, const SceneCentre& centre) {
  const auto cartesian = any_of(table, cartesian_keys);
  const auto element = any_of(table, names_of_elements());
  const auto of_file = any_of(table, file_keys);
  const std::string right = fmt::format(
      "either {}, elements ({} among others), or the file of an orbit message, "
      "oem_file or opm_file",
      fmt::join(cartesian_keys, " and "), "a_km, e, i_deg, raan_deg, argp_deg, ta_deg");
  const auto refuse_both = [&](std::string_view one, std::string_view other) {
    table.fail(other,
               fmt::format("both forms of an orbit, got {} and {}, must be {}", one, other, right));
  };
  if (cartesian && element) refuse_both(*cartesian, *element);
  if (cartesian && of_file) refuse_both(*cartesian, *of_file);
  if (element && of_file) refuse_both(*element, *of_file);
  Orbit orbit;
  if (cartesian) {
    orbit.state = read_position_and_velocity(table);
  } else if (element) {
    if (centre.system.earth && axes_named(centre.system.earth->axes) == EarthAxes::itrf) {
      table.fail(*element,
                 "elements along axes that turn with the Earth, where no ellipse rests, got axes = "
                 "\"ITRF\", must be position_km and velocity_km_s, or other axes: GCRF, EME2000, "
                 "MOD or TOD");
    }
    orbit.state = read_elements(table, centre);
  } else if (of_file) {
    NominalFromFile read = read_nominal_file(table, centre);
    orbit = {read.state, std::move(read.file)};
  } else {
    table.fail("", "no orbit, got neither of its forms, must be " + right);
  }
  if (centre.system.earth) {
    orbit.state = in_gcrf(table, orbit.state, orbit.file, *centre.system.earth);
  }
  return orbit;
}

}  // namespace hamjet::io
