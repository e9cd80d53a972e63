#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../../studies/descriptions/system_description.hpp"
#include "../../studies/earth_system.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "../systems/scene_earth.hpp"
#include "scene_orbit.hpp"

namespace hamjet::io {
namespace {

/// Largest distance of the nominal in the units that the scene chooses, and largest inverse of the
/// distance. Coefficients of degree d scale as the distance to the power -(d + 2), and must not
/// underflow to zero.
constexpr double greatest_distance = 1e9;

double rounded(const Extended& value) { return convert<double>(value); }

CanonicalScale scale_of(const Extended& length_km, double mu_km3_s2) {
  return {length_km, sqrt(length_km * length_km * length_km / mu_km3_s2)};
}

std::vector<double> canonical_state(const CartesianState& orbit, const CanonicalScale& scale) {
  std::vector<double> state;
  for (const Extended& q : orbit.position_km) state.push_back(rounded(q / scale.length_km));
  for (const Extended& v : orbit.velocity_km_s) {
    state.push_back(rounded(v * scale.time_s / scale.length_km));
  }
  return state;
}

void require_within_binary64(const TableReader& nominal, const CartesianState& orbit,
                             const CanonicalScale& scale) {
  const double units[] = {rounded(scale.length_km), rounded(scale.time_s)};
  const std::vector<double> state = canonical_state(orbit, scale);
  const auto usable = [](double unit) { return std::isnormal(unit); };
  const auto finite = [](double value) { return std::isfinite(value); };
  if (std::all_of(std::begin(units), std::end(units), usable) &&
      std::all_of(state.begin(), state.end(), finite)) {
    return;
  }
  nominal.fail(
      "", fmt::format("out of range in canonical units, got a unit of length of {:.3g} km and a "
                      "unit of time of {:.3g} s, must leave units and state within binary64",
                      units[0], units[1]));
}

Nominal canonical_orbit(const TableReader& nominal, const CartesianState& orbit, double mu_km3_s2,
                        const std::optional<double>& length_km, SceneUnits wanted) {
  const auto& [x, y, z] = orbit.position_km;
  const Extended distance_km = sqrt(x * x + y * y + z * z);
  Nominal result;
  const CanonicalScale own = scale_of(distance_km, mu_km3_s2);
  result.told = length_km ? scale_of(Extended(*length_km), mu_km3_s2) : own;
  require_within_binary64(nominal, orbit, result.told);
  const double distance = rounded(distance_km / result.told.length_km);
  if (length_km && !(distance >= 1 / greatest_distance && distance <= greatest_distance)) {
    nominal.fail("", fmt::format("out of range in canonical units, got a distance of {:.3g} from "
                                 "the centre with units.length_km = {:g}, must be between {:g} and "
                                 "{:g}, or higher coefficients would underflow",
                                 distance, *length_km, 1 / greatest_distance, greatest_distance));
  }
  require_within_binary64(nominal, orbit, own);
  result.scale = wanted == SceneUnits::chiefs ? own : result.told;
  result.state = canonical_state(orbit, result.scale);
  result.period_s = osculating_period_s(orbit, mu_km3_s2);
  return result;
}

}  // namespace

double CanonicalScale::length_of_km(double km) const { return rounded(Extended(km) / length_km); }

double CanonicalScale::time_of_s(double seconds) const {
  return rounded(Extended(seconds) / time_s);
}

double Nominal::time_of_canonical(double given) const {
  return rounded(Extended(given) * told.time_s / scale.time_s);
}

double Nominal::told_time(double time) const {
  return rounded(Extended(time) * scale.time_s / told.time_s);
}

const TableDescription& units_table() {
  static const TableDescription table = {
      {{"length_km", form::positive(), absent::refused(), "canonical unit of length"},
       {"time_s",
        form::positive(),
        absent::refused(),
        "what a time of 1 means",
        {description_of(SystemModel::own).name}},
       {"mass_kg",
        form::positive(),
        absent::other("unsaid"),
        "what a mass of 1 means: momenta and energies are then told in kilograms too",
        {description_of(SystemModel::own).name}}},
      "Canonical numbers are read and given in this unit of length. `run` and `compare` compute in "
      "it; everything else computes in the chief's own unit, its distance at the start. The "
      "numbers of a model `own` are in units of "
      "`length_km` and `time_s`, without this table in metres and seconds."};
  return table;
}

const TableDescription& nominal_table() {
  const std::vector<std::string_view> other = {other_models};
  const std::vector<std::string_view> own = {description_of(SystemModel::own).name};
  const auto of_model = form::words("array of n numbers", form::array(form::number()));
  static const TableDescription table = {
      joined<SceneKey>({orbit_keys({orbits}),
                        epoch_keys(),
                        {{"position_m", of_model, absent::refused(),
                          "coordinate of each degree of freedom", other},
                         {"momentum_kg_m_s", of_model, absent::refused(),
                          "momentum of each degree of freedom", other},
                         {"coordinates", of_model, absent::other("`states`"),
                          "coordinates, in the system's own units", own},
                         {"momenta", of_model, absent::other("`states`"),
                          "momenta, in the system's own units", own},
                         {"states", of_model, absent::other("`coordinates` and `momenta`"),
                          "states of a vector field, in the system's own units", own}}}),
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
  units.check_keys(orbits, "an orbit");
  return units.number("length_km");
}

void read_unit_of_mass(const TableReader& units, Scene& scene) {
  if (scene.system.model != SystemModel::own || !units.has("mass_kg")) return;
  if (!scene.system.own_text->is_hamiltonian()) {
    units.fail("mass_kg",
               "of no use, got a vector field, which has no momenta and no energy; must "
               "be left out");
  }
  const double mass_kg = units.positive_number("mass_kg");
  for (const double size :
       {momentum_kg_m_s(scene.units, mass_kg), energy_J(scene.units, mass_kg)}) {
    if (std::isnormal(size)) continue;
    units.fail("mass_kg", fmt::format("out of range, got {:.6g}, must be such that momenta and "
                                      "energies of 1 are within binary64",
                                      mass_kg));
  }
  scene.mass_kg = mass_kg;
}

CanonicalScale read_units_of_own(const TableReader& units) {
  units.check_keys();
  return {Extended(units.number("length_km")), Extended(units.number("time_s"))};
}

namespace {

/// The state of a system that the scene writes; adjoint variables begin with 0, and parameters of
/// the state are at the end.
std::vector<double> read_own_state(const TableReader& nominal, const SystemSettings& system) {
  const std::size_t n = degrees_of_freedom_of(system);
  const bool is_hamiltonian = system.own_text->is_hamiltonian();
  std::vector<double> state = nominal.numbers(is_hamiltonian ? "coordinates" : "states", n);
  std::vector<double> momenta(n, 0);
  if (is_hamiltonian) momenta = nominal.numbers("momenta", n);
  state.insert(state.end(), momenta.begin(), momenta.end());
  for (const double value : parameter_values(system)) state.push_back(value);
  return state;
}

}  // namespace

Nominal read_nominal(const TableReader& nominal, const SystemSettings& system,
                     const std::optional<double>& length_km, SceneUnits units,
                     const std::optional<std::string>& center_name) {
  if (system.model == SystemModel::own) {
    const std::string_view own = model_name(system.model);
    nominal.check_keys(own, "the model " + std::string(own));
    Nominal result;
    result.scale = result.told = {Extended(1) / 1000, Extended(1)};
    result.state = read_own_state(nominal, system);
    return result;
  }
  check_keys_of_model(nominal, system.model);
  if (is_orbit(system.model)) {
    refuse_epoch_keys(nominal, system);
    const SceneCentre centre = {system, center_name};
    Orbit orbit = read_orbit(nominal, centre);
    Nominal result = canonical_orbit(nominal, orbit.state, system.mu_km3_s2, length_km, units);
    for (const double value : parameter_values(system)) result.state.push_back(value);
    result.orbit = orbit.state;
    result.centre = centre;
    if (orbit.file) result.ephemeris = orbit.file->ephemeris;
    result.file = std::move(orbit.file);
    return result;
  }
  Nominal result;
  result.scale = result.told = {Extended(1) / 1000, Extended(1)};
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
