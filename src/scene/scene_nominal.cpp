#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../studies/descriptions/system_description.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "scene_nominal_file.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

const std::vector<std::string_view> cartesian_keys = {"position_km", "velocity_km_s"};
const std::vector<std::string_view> element_keys = {"a_km",     "e",        "i_deg",
                                                    "raan_deg", "argp_deg", "ta_deg"};
const std::vector<std::string_view> file_keys = {"oem_file", "opm_file", "epoch", "object"};

/// Largest distance of the nominal in units that the scene chooses, and largest inverse of it.
/// Coefficients of degree d go as the distance to the power -(d + 2), and must not underflow to a
/// wrong zero.
constexpr double greatest_distance = 1e9;

double rounded(const Extended& value) { return convert<double>(value); }

CartesianState read_elements(const TableReader& nominal, double mu_km3_s2) {
  nominal.require(element_keys);
  OsculatingElements elements;
  elements.semi_major_axis_km = nominal.number("a_km");
  elements.eccentricity = nominal.number("e");
  if (elements.eccentricity < 0 || elements.eccentricity >= 1) {
    nominal.fail("e", fmt::format("out of range, got {}, must be at least 0 and below 1 (other "
                                  "orbits are given by position_km and velocity_km_s)",
                                  nominal.found("e")));
  }
  elements.inclination_deg = nominal.number("i_deg");
  elements.ascending_node_deg = nominal.number("raan_deg");
  elements.argument_of_perigee_deg = nominal.number("argp_deg");
  elements.true_anomaly_deg = nominal.number("ta_deg");
  return state_from_elements(elements, mu_km3_s2);
}

CartesianState read_position_and_velocity(const TableReader& nominal) {
  nominal.require(cartesian_keys);
  CartesianState state;
  const std::vector<double> position = nominal.numbers("position_km", 3);
  const std::vector<double> velocity = nominal.numbers("velocity_km_s", 3);
  std::copy(position.begin(), position.end(), state.position_km.begin());
  std::copy(velocity.begin(), velocity.end(), state.velocity_km_s.begin());
  if (std::all_of(position.begin(), position.end(), [](double x) { return x == 0; })) {
    nominal.fail("position_km",
                 "at the centre of attraction, got [0, 0, 0], must be any other point");
  }
  return state;
}

CartesianState read_orbit(const TableReader& nominal, const SceneCentre& centre,
                          std::optional<NominalFile>& file) {
  const auto any_of = [&nominal](const std::vector<std::string_view>& keys) {
    const auto given = std::find_if(keys.begin(), keys.end(),
                                    [&](std::string_view key) { return nominal.has(key); });
    return given != keys.end() ? std::optional(*given) : std::nullopt;
  };
  const auto cartesian = any_of(cartesian_keys);
  const auto element = any_of(element_keys);
  const auto of_file = any_of(file_keys);
  const std::string right =
      fmt::format("either {}, all of {}, or the file of an orbit message, oem_file or opm_file",
                  fmt::join(cartesian_keys, " and "), listed(element_keys));
  const auto refuse_both = [&](std::string_view one, std::string_view other) {
    nominal.fail(
        other, fmt::format("both forms of an orbit, got {} and {}, must be {}", one, other, right));
  };
  if (cartesian && element) refuse_both(*cartesian, *element);
  if (cartesian && of_file) refuse_both(*cartesian, *of_file);
  if (element && of_file) refuse_both(*element, *of_file);
  if (cartesian) return read_position_and_velocity(nominal);
  if (element) return read_elements(nominal, centre.system.mu_km3_s2);
  if (!of_file) nominal.fail("", "no orbit, got neither of its forms, must be " + right);
  NominalFromFile read = read_nominal_file(nominal, centre);
  file = std::move(read.file);
  return read.state;
}

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
  const std::vector<std::string_view> orbit = {orbits}, other = {other_models};
  const auto other_form = absent::other("another form");
  // Angles go once around in either sense; what is beyond is no angle in degrees.
  const auto angle = form::between(-360, 360);
  const auto of_model = form::words("array of n numbers", form::array(form::number()));
  static const TableDescription table = {
      {{"position_km", form::array(form::number(), 3), other_form, "x, y, z from the centre",
        orbit},
       {"velocity_km_s", form::array(form::number(), 3), other_form, "their rates", orbit},
       {"a_km", form::positive(), other_form, "semi-major axis", orbit},
       {"e", form::words("number from 0, below 1", form::number()), other_form, "eccentricity",
        orbit},
       {"i_deg", form::between(0, 180), other_form, "inclination", orbit},
       {"raan_deg", angle, other_form, "right ascension of the ascending node", orbit},
       {"argp_deg", angle, other_form, "argument of perigee", orbit},
       {"ta_deg", angle, other_form, "true anomaly", orbit},
       {"oem_file", form::text(), other_form, "an orbit ephemeris message of CCSDS", orbit},
       {"opm_file", form::text(), other_form, "an orbit parameter message of CCSDS", orbit},
       {"epoch", form::words("`\"YYYY-MM-DDThh:mm:ss\"` or `\"YYYY-DDDThh:mm:ss\"`"),
        absent::other("the first of the file"), "of the state to take; nothing is interpolated",
        orbit},
       {"object", form::text(), absent::other("the only one of the file"),
        "name or identifier of the object to take", orbit},
       {"position_m", of_model, absent::refused(), "of each degree of freedom", other},
       {"momentum_kg_m_s", of_model, absent::refused(), "likewise", other}},
      "An orbit has one of three forms: position and velocity, all six osculating elements, or the "
      "file of a message, whose path is relative to the scene's folder."};
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
    std::optional<NominalFile> file;
    const CartesianState orbit = read_orbit(nominal, {system, center_name}, file);
    Nominal result = canonical_orbit(nominal, orbit, system.mu_km3_s2, length_km);
    result.file = std::move(file);
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
