#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../studies/descriptions/system_description.hpp"
#include "../text/scene_message.hpp"
#include "scene_orbit.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// Largest distance of the nominal in units that the scene chooses, and largest inverse of it.
/// Coefficients of degree d go as the distance to the power -(d + 2), and must not underflow to a
/// wrong zero.
constexpr double greatest_distance = 1e9;

double rounded(const Extended& value) { return convert<double>(value); }

Nominal canonical_orbit(const TableReader& nominal, const CartesianState& orbit, double mu_km3_s2,
                        const std::optional<double>& length_km) {
  const auto& [x, y, z] = orbit.position_km;
  const Extended distance_km = sqrt(x * x + y * y + z * z);
  Nominal result;
  CanonicalScale& scale = result.scale;
  scale.length_km = length_km ? Extended(*length_km) : distance_km;
  scale.time_s = sqrt(scale.length_km * scale.length_km * scale.length_km / mu_km3_s2);
  for (const Extended& q : orbit.position_km) result.state.push_back(rounded(q / scale.length_km));
  for (const Extended& v : orbit.velocity_km_s) {
    result.state.push_back(rounded(v * scale.time_s / scale.length_km));
  }
  const double units[] = {rounded(scale.length_km), rounded(scale.time_s)};
  const double distance = rounded(distance_km / scale.length_km);
  const auto usable = [](double unit) { return std::isnormal(unit); };
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(std::begin(units), std::end(units), usable) ||
      !std::all_of(result.state.begin(), result.state.end(), finite)) {
    nominal.fail(
        "",
        fmt::format("out of range in canonical units, got a unit of length of {:.3g} km and a unit "
                    "of time of {:.3g} s, must leave units and state within binary64",
                    units[0], units[1]));
  }
  if (length_km && !(distance >= 1 / greatest_distance && distance <= greatest_distance)) {
    nominal.fail("", fmt::format("out of range in canonical units, got a distance of {:.3g} from "
                                 "the centre with units.length_km = {:g}, must be between {:g} and "
                                 "{:g}, or higher coefficients would underflow",
                                 distance, *length_km, 1 / greatest_distance, greatest_distance));
  }
  result.period_s = osculating_period_s(orbit, mu_km3_s2);
  return result;
}

}  // namespace

double CanonicalScale::length_of_km(double km) const { return rounded(Extended(km) / length_km); }

double CanonicalScale::time_of_s(double seconds) const {
  return rounded(Extended(seconds) / time_s);
}

const TableDescription& units_table() {
  static const TableDescription table = {
      {{"length_km", form::positive(), absent::refused(), "canonical unit of length"}}};
  return table;
}

const TableDescription& nominal_table() {
  const std::vector<std::string_view> other = {other_models};
  const auto of_model = form::words("array of n numbers", form::array(form::number()));
  static const TableDescription table = {
      joined<SceneKey>(
          {orbit_keys({orbits}),
           {{"position_m", of_model, absent::refused(), "of each degree of freedom", other},
            {"momentum_kg_m_s", of_model, absent::refused(), "likewise", other}}}),
      "An orbit has one of three forms: position and velocity, osculating elements, or the file of "
      "a message, whose path is relative to the scene's folder. Elements are size and shape "
      "(`a_km` "
      "with `e`, `perigee_height_km` with `apogee_height_km`, `period_s` with `e`, or `height_km` "
      "of a circle), `i_deg`, `raan_deg`, `argp_deg`, and a place (one of `ta_deg`, `ea_deg`, "
      "`ma_deg`, `u_deg`); on a circle `u_deg` may stand for `argp_deg` too. Heights are above "
      "`radius_km` of `[system]`."};
  return table;
}

double read_unit_of_length(const TableReader& units, SystemModel model) {
  if (!is_orbit(model)) {
    units.fail("", fmt::format("not available for the model {}, got a unit of length, must be left "
                               "out: its units are metre, second and kilogram",
                               model_name(model)));
  }
  units.check_keys();
  return units.number("length_km");
}

Nominal read_nominal(const TableReader& nominal, const SystemSettings& system,
                     const std::optional<double>& length_km,
                     const std::optional<std::string>& center_name) {
  check_keys_of_model(nominal, system.model);
  if (is_orbit(system.model)) {
    const SceneCentre centre = {system, center_name};
    Orbit orbit = read_orbit(nominal, centre);
    Nominal result = canonical_orbit(nominal, orbit.state, system.mu_km3_s2, length_km);
    result.orbit = orbit.state;
    result.centre = centre;
    if (orbit.file) result.ephemeris = orbit.file->ephemeris;
    result.file = std::move(orbit.file);
    return result;
  }
  Nominal result;
  result.scale = {Extended(1) / 1000, Extended(1)};
  const std::size_t n = degrees_of_freedom_of(system);
  result.state = nominal.numbers("position_m", n);
  const auto is_zero = [](double x) { return x == 0; };
  const std::string_view refusal = description_of(system.model).no_start_at_origin;
  if (!refusal.empty() && std::all_of(result.state.begin(), result.state.end(), is_zero)) {
    nominal.fail("position_m", fmt::format("{}, got [{}], must be any other point", refusal,
                                           fmt::join(result.state, ", ")));
  }
  const std::vector<double> momenta = nominal.numbers("momentum_kg_m_s", n);
  result.state.insert(result.state.end(), momenta.begin(), momenta.end());
  return result;
}

}  // namespace hamjet::io
