#pragma once

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/study_reader.hpp"
#include "scene_samples.hpp"

// The places at which the tests try the keys of scenes: shipped scenes, changed as with --set.

namespace hamjet::io {

/// A key in a scene that can have it.
struct Place {
  std::string file = {};  ///< if empty, the scene of the table
  std::vector<Override> changes = {};
  std::string value = {};  ///< if empty, made from the key's form
};

/// The places of the keys of a table, or of one owner of the table's keys.
inline Place place_of(const std::string& table, std::string_view owner) {
  static const std::string orbit_file = "transfer-sun-synchronous";
  static const std::string oscillator_file = "paper/harmonic-oscillator";
  static const Override plane = {"nominal", "{position_m=[1, 1], momentum_kg_m_s=[0, 0]}"};
  static const std::map<std::string, Place, std::less<>> of_models = {
      {"earth", {"earth/drag"}},
      {"own", {"own/pendulum"}},
      {"kepler", {orbit_file, {{"system", "{model=\"kepler\", mu_km3_s2=4e5}"}}}},
      {"harmonic-oscillator", {oscillator_file}},
      {"oscillator-pair",
       {oscillator_file,
        {plane, {"system", "{model=\"oscillator-pair\", stiffness_N_per_m=[1, 2]}"}}}},
      {"spring-pendulum",
       {oscillator_file,
        {plane,
         {"system",
          "{model=\"spring-pendulum\", stiffness_N_per_m=1, length_m=1, gravity_m_s2=1}"}}}},
      {"fermi-pasta-ulam",
       {oscillator_file,
        {plane, {"system", "{model=\"fermi-pasta-ulam\", omega_rad_per_s=1, pairs=1}"}}}}};
  static const std::map<std::string, Place, std::less<>> of_tables = {
      {"spacecraft", {"earth/drag"}},
      {"formation", {orbit_file, {{"formation", "{separation_km=1}"}}}},
      {"deputy", {orbit_file, {{"deputy", "{position_m=[0, 100, 0]}"}}}},
      {"eval", {orbit_file, {{"eval", "{tolerance_m=2}"}}}},
      {"bounded", {orbit_file, {{"bounded", "{box={half_widths_m=[1, 1, 1]}}"}}}},
      {"event", {orbit_file, {{"event", "{surface=\"equator\"}"}}}},
      {"periodic", {"own/pendulum", {{"periodic", "{family={along=\"theta\", to=3}}"}}}},
      {"figure", {orbit_file, {{"figure", "{quantity=\"exactness\"}"}}}},
      {"assignment",
       {orbit_file,
        {{"assignment", "{deputy=[{position_m=[1, 0, 0]}], slot=[{position_m=[2, 0, 0]}]}"}}}},
      {"uncertainty",
       {orbit_file,
        {{"deputy", "{position_m=[0, 100, 0]}"},
         {"uncertainty",
          "{position_m=[1, 1, 1], deputy={position_m=[1, 1, 1]}, count=2, "
          "burn={velocity_change_m_s=[1, 0, 0], magnitude=0.1, direction_deg=1}, "
          "collision={radius_m=5}, safety={keep_apart_m=5, keep_out_m=[1, 1, 1], "
          "deputy=[{position_m=[0, 200, 0]}]}}"}}}},
      {"thruster",
       {orbit_file,
        {{"thruster", "{thrust_N=1, mass_kg=100, specific_impulse_s=220, propellant_kg=2}"}}}},
      {"ephemeris",
       {orbit_file,
        {{"ephemeris",
          "{epoch=\"2026-01-01T00:00:00\", time_system=\"TAI\", reference_frame=\"EME2000\", "
          "center_name=\"EARTH\"}"}}}},
      {"canonical_transformation", {"paper/double-well"}},
      {"energy_conservation", {"paper/energy-midpoint-kepler"}},
      {"optimal_control", {"paper/free-end"}}};
  if (table == "integrator.0") {
    const bool is_cvode = owner.starts_with("cvode");
    return {
        orbit_file,
        {{table, fmt::format("{{label=\"a\", method=\"{}\", {}}}", owner.empty() ? "gauss" : owner,
                             is_cvode ? "tolerance=1e-9" : "step_canonical=0.1")}}};
  }
  if (owner == other_models) return {oscillator_file};
  if (const auto model = of_models.find(owner); model != of_models.end()) return model->second;
  static const std::set<std::string> left_out = {
      "units",  "generating_function", "output", "relative_hamiltonian",
      "checks", "reference",           "compare"};
  if (left_out.contains(table)) return {orbit_file, {{table, "{}"}}};
  const auto own = of_tables.find(table.substr(0, table.find('.')));
  return own != of_tables.end() ? own->second : Place{orbit_file};
}

/// The values and surroundings of keys that do not follow from the keys' forms.
inline const std::map<std::string, Place>& special_places() {
  static const Override no_duration = {"jet.duration_orbits", "null"};
  static const Override no_epoch = {"nominal.epoch_utc", "null"};
  static const Override no_count = {"transfer.count", "null"};
  static const Override no_validity_count = {"validity.count", "null"};
  static const Override no_uncertainty_count = {"uncertainty.count", "null"};
  static const std::string covariance_text =
      "[[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], "
      "[0, 0, 0, 0, 1, 0.5], [0, 0, 0, 0, 0.5, 1]]";
  static const std::string cdm = "\"../../tests/fuzz/corpus/orbit_message/conjunction.cdm\"";
  static const Override dated = {
      "ephemeris",
      "{epoch=\"2010-03-13T22:37:52.618\", time_system=\"UTC\", reference_frame=\"EME2000\", "
      "center_name=\"EARTH\"}"};
  // The states of its two objects.
  static const Override of_first = {"nominal",
                                    "{position_km=[2570.097065, 2244.654904, 6281.497978], "
                                    "velocity_km_s=[4.418769571, 4.833547743, -3.526774282]}"};
  static const Override of_second = {"nominal",
                                     "{position_km=[2569.540800, 2245.093614, 6281.599946], "
                                     "velocity_km_s=[-2.888612500, -6.007247516, 3.328770172]}"};
  static const Override at_chief = {"deputy.position_m", "[0, 1, 0]"};
  static const Override no_rotation = {"canonical_transformation.rotation_cosine", "null"};
  static const Override matrix = {"canonical_transformation.matrix", "[[1, 0], [0, 1]]"};
  static const Override no_step = {"integrator.0.step_canonical", "null"};
  static const Override field = {
      "system", "{model=\"zonal-gravity\", gravity_file=\"../gravity/EGM96-zonals.gfc\"}"};
  static const Override highest = {"system.highest_zonal", "6"};
  static const Override cartesian = {"nominal",
                                     "{position_km=[7000, 0, 0], velocity_km_s=[0, 7.5, 1]}"};
  static const Override no_orbits = {"energy_conservation.duration_orbits", "null"};
  static const std::string message = "orbit-messages";
  static const std::string mars = "\"../../tests/fuzz/corpus/orbit_message/ephemeris.oem\"";
  static const std::string densities = "[5e-7, 3e-10, 2e-11, 4e-13]";
  static const Override no_deputy = {"deputy", "null"};
  static const Override ellipse = {
      "deputy", "{a_km=7086, e=0.001, i_deg=98.2, raan_deg=0, argp_deg=90, ta_deg=0}"};
  static const Override states = {"deputy",
                                  "{position_km=[0, -1000, 7000], velocity_km_s=[-7.5, 0, 0]}"};
  static const Override of_message = {"deputy", "{opm_file=\"eutelsat-w4.opm\"}"};
  static const Override on_circle = {"nominal", "{height_km=700, i_deg=98, raan_deg=0, u_deg=0}"};
  static const Override between = {"nominal",
                                   "{perigee_height_km=700, apogee_height_km=800, i_deg=98, "
                                   "raan_deg=0, argp_deg=0, ta_deg=0}"};
  static const Override no_axis = {"nominal.a_km", "null"};
  static const Override no_anomaly = {"nominal.ta_deg", "null"};
  static const Override deputy_on_circle = {"deputy",
                                            "{height_km=701, i_deg=98.2, raan_deg=0, u_deg=90}"};
  static const Override deputy_between = {"deputy",
                                          "{perigee_height_km=700, apogee_height_km=720, "
                                          "i_deg=98.2, raan_deg=0, argp_deg=90, ta_deg=0}"};
  static const Override no_deputy_axis = {"deputy.a_km", "null"};
  static const Override no_deputy_anomaly = {"deputy.ta_deg", "null"};
  static const Override waypoint = {"transfer.waypoint", "[{time_s=200, position_m=[1, 0, 0]}]"};
  static const Override lasting_thrust = {"transfer.thrust", "\"energy-optimal\""};
  static const Override law = {"transfer.feedback", "2"};
  static const Override errors = {"transfer.errors", "{}"};
  static const Override no_thruster = {"thruster", "null"};
  static const Override weak_thruster = {"thruster", "{acceleration_m_s2 = 1e-3}"};
  static const Override no_time = {"transfer.waypoint.0.time_s", "null"};
  static const Override vector_field = {
      "system", "{model=\"own\", states=[\"x\", \"v\"], vector_field={x=\"v\", v=\"-x\"}}"};
  static const Override state = {"nominal", "{states=[1, 0]}"};
  static const Override no_kinds = {"generating_function", "null"};
  static const std::map<std::string, Place> listed = {
      {"uncertainty.collision.window_s", {"", {}, "[1, 2]"}},
      {"uncertainty.safety.window_s", {"", {}, "[1, 2]"}},
      {"uncertainty.safety.burn_shares", {"", {}, "[0.5, 1]"}},
      {"uncertainty.coordinates", {"", {}, "[\"spherical\", \"flow-box\"]"}},
      {"event.surface", {"", {}, "\"apsis\""}},
      {"event.normal", {"", {{"event.surface", "\"plane\""}}}},
      {"event.offset_km", {"", {{"event.surface", "\"plane\""}, {"event.normal", "[1, 2, 3]"}}}},
      {"event.expression", {"", {{"event.surface", "\"expression\""}}, "\"x\""}},
      {"event.distance_km", {"", {{"event.surface", "\"distance\""}}}},
      {"periodic.hold", {"", {}, "\"theta\""}},
      {"periodic.family.along", {"", {}, "\"energy\""}},
      {"bounded.box.reference", {"", {}, "\"member\""}},
      {"bounded.box.position_m", {"", {{"bounded.box.reference", "\"rest\""}}}},
      {"system.model", {"", {}, "\"zonal-gravity\""}},
      {"generating_function.despite_drag",
       {"earth/pair", {{"generating_function", "{kinds=[\"F1\"]}"}}, "true"}},
      {"spacecraft.drag_m2_kg", {"", {{"spacecraft", "{drag_m2_kg=0.01}"}}}},
      {"system.shadow", {"", {{"system.radiation", "true"}}}},
      {"system.density_file",
       {"", {{"system.atmosphere", "\"table\""}}, "\"../../../tests/scene/density_table.csv\""}},
      {"system.heights_km",
       {"",
        {{"system.atmosphere", "\"table\""}, {"system.densities_kg_m3", densities}},
        "[100, 200, 300, 600]"}},
      {"system.densities_kg_m3",
       {"",
        {{"system.atmosphere", "\"table\""}, {"system.heights_km", "[100, 200, 300, 500]"}},
        densities}},
      {"spacecraft.sunlit_area_m2", {"", {{"system.radiation", "true"}}}},
      {"spacecraft.reflection_coefficient", {"", {{"system.radiation", "true"}}}},
      {"spacecraft.radiation_m2_kg", {"", {{"system.radiation", "true"}}}},
      {"system.gravity_degree", {"", {}, "12"}},
      {"system.gravity_order", {"", {}, "5"}},
      {"system.orientation_file",
       {"",
        {{"nominal.epoch_utc", "\"2010-07-18T12:00:00\""}, {"jet.duration_s", "1000"}},
        "\"../../../tests/fuzz/corpus/earth_orientation/plain.txt\""}},
      {"system.tide_system",
       {"", {{"system.gravity_file", "\"../../gravity/EGM96-to-20.gfc\""}}, "\"tide_free\""}},
      {"nominal.epoch_utc", {"earth/pair", {}, "\"2026-03-01T00:00:00\""}},
      {"nominal.epoch_tt", {"earth/pair", {no_epoch}, "\"2026-03-01T00:00:00\""}},
      {"nominal.epoch_tai", {"earth/pair", {no_epoch}, "\"2026-03-01T00:00:00\""}},
      {"nominal.epoch_gps", {"earth/pair", {no_epoch}, "\"2026-03-01T00:00:00\""}},
      {"nominal.axes", {"earth/pair"}},
      {"system.gravity_file",
       {"transfer-sun-synchronous", {field, highest}, "\"../gravity/EGM96-zonals.gfc\""}},
      {"system.highest_zonal", {"", {field}}},
      {"system.zonals", {"", {field}}},
      {"system.gravity_epoch", {"", {field, highest}, "\"2005-01-01T00:00:00\""}},
      {"system.leave_out_C10", {"transfer-sun-synchronous", {field, highest}}},
      {"system.pairs", {"", {}, "1"}},
      {"system.coordinates", {"", {}, "[\"theta\"]"}},
      {"system.momenta", {"", {}, "[\"L\"]"}},
      {"system.hamiltonian", {"", {}, "\"L^2/2 + theta^2\""}},
      {"system.parameters", {"", {}, "{g = 2, h = \"g/3\"}"}},
      {"system.definitions", {"", {}, "{speed = \"L/2\"}"}},
      {"system.states", {"own/pendulum", {vector_field, state, no_kinds}, "[\"x\", \"v\"]"}},
      {"system.vector_field",
       {"own/pendulum", {vector_field, state, no_kinds}, "{x = \"v\", v = \"-2*x\"}"}},
      {"nominal.states", {"own/pendulum", {vector_field, state, no_kinds}, "[1, 2]"}},
      {"units.time_s", {"own/pendulum", {{"units", "{length_km=1, time_s=1}"}}}},
      {"units.mass_kg", {"own/pendulum", {{"units", "{length_km=1, time_s=1, mass_kg=1}"}}}},
      {"nominal.a_km", {"", {}, "10000"}},
      {"nominal.position_km", {"", {cartesian}, "[7000, 1, 0]"}},
      {"nominal.velocity_km_s", {"", {cartesian}, "[0, 7, 1]"}},
      {"nominal.e", {"", {}, "0.5"}},
      {"nominal.perigee_height_km", {"", {between}, "750"}},
      {"nominal.apogee_height_km", {"", {between}, "750"}},
      {"nominal.period_s", {"", {no_axis}, "7000"}},
      {"nominal.height_km", {"", {on_circle}, "800"}},
      {"nominal.ea_deg", {"", {no_anomaly}}},
      {"nominal.ma_deg", {"", {no_anomaly}}},
      {"nominal.u_deg", {"", {no_anomaly}}},
      {"nominal.oem_file",
       {message,
        {{"nominal.opm_file", "null"},
         {"jet.duration_orbits", "null"},
         {"jet.duration_s", "100"},
         {"system", "{model=\"kepler\", mu_km3_s2=42828.37}"}},
        mars}},
      {"nominal.opm_file", {message, {}, "\"eutelsat-w4.opm\""}},
      {"nominal.epoch", {message, {}, "\"2021-06-03T00:00:00\""}},
      {"nominal.object", {message, {}, "\"EUTELSAT W4\""}},
      {"nominal.manoeuvres", {message, {}, "\"leave-out\""}},
      {"nominal.position_m", {"", {}, "[2]"}},
      {"nominal.momentum_kg_m_s", {"", {}, "[2]"}},
      {"deputy.a_km", {"", {no_deputy, ellipse}, "7087"}},
      {"deputy.elements", {"", {no_deputy, ellipse}, "\"mean\""}},
      {"deputy.e", {"", {no_deputy, ellipse}, "0.0011"}},
      {"deputy.i_deg", {"", {no_deputy, ellipse}, "98.3"}},
      {"deputy.raan_deg", {"", {no_deputy, ellipse}, "0.1"}},
      {"deputy.argp_deg", {"", {no_deputy, ellipse}, "90.1"}},
      {"deputy.ta_deg", {"", {no_deputy, ellipse}, "0.1"}},
      {"deputy.perigee_height_km", {"", {no_deputy, deputy_between}, "702"}},
      {"deputy.apogee_height_km", {"", {no_deputy, deputy_between}, "718"}},
      {"deputy.period_s", {"", {no_deputy, ellipse, no_deputy_axis}, "5938"}},
      {"deputy.height_km", {"", {no_deputy, deputy_on_circle}, "702"}},
      {"deputy.ea_deg", {"", {no_deputy, ellipse, no_deputy_anomaly}, "0.1"}},
      {"deputy.ma_deg", {"", {no_deputy, ellipse, no_deputy_anomaly}, "0.1"}},
      {"deputy.u_deg", {"", {no_deputy, ellipse, no_deputy_anomaly}, "90.1"}},
      {"deputy.position_km", {"", {no_deputy, states}, "[0, -1010, 7000]"}},
      {"deputy.velocity_km_s", {"", {no_deputy, states}, "[-7.6, 0, 0]"}},
      {"deputy.oem_file",
       {message,
        {{"nominal.opm_file", "null"},
         {"nominal.oem_file", mars},
         {"jet.duration_orbits", "null"},
         {"jet.duration_s", "100"},
         {"system", "{model=\"kepler\", mu_km3_s2=42828.37}"}},
        mars}},
      {"deputy.opm_file", {message, {}, "\"eutelsat-w4.opm\""}},
      {"deputy.epoch", {message, {of_message}, "\"2021-06-03T00:00:00\""}},
      {"deputy.object", {message, {of_message}, "\"EUTELSAT W4\""}},
      {"deputy.manoeuvres", {message, {of_message}, "\"leave-out\""}},
      {"jet.variables", {"", {}, R"(["x", "y", "z", "px", "py", "pz"])"}},
      {"jet.duration_s", {"", {no_duration}, "100"}},
      {"jet.duration_canonical", {"", {no_duration}}},
      {"integrator.0.step_s", {"", {no_step}, "100"}},
      {"integrator.0.tolerance", {"", {no_step}}},
      {"generating_function.kinds", {"", {}, R"(["F1", "qpq-qqp", "auto"])"}},
      {"relative_hamiltonian.times_canonical", {"", {}, "[0, 1]"}},
      {"output.formats", {"", {}, "[\"dace\"]"}},
      {"compare.orders", {"", {}, "[4]"}},
      {"figure.kind", {"", {}, "\"F2\""}},
      {"transfer.times_s", {"", {no_count}, "[100, 200]"}},
      {"transfer.times_orbits", {"", {no_count}}},
      {"transfer.times_canonical", {"", {no_count}}},
      {"transfer.thrust_order", {"", {lasting_thrust}}},
      {"transfer.largest_thrust_m_s2", {"", {lasting_thrust}}},
      {"transfer.feedback", {"", {lasting_thrust}}},
      {"transfer.errors.position_m", {"", {lasting_thrust, law, errors}, "[1, 2, 3]"}},
      {"transfer.errors.velocity_m_s", {"", {lasting_thrust, law, errors}, "[1, 2, 3]"}},
      {"transfer.errors.magnitude", {"", {lasting_thrust, law, errors}}},
      {"transfer.errors.direction_deg", {"", {lasting_thrust, law, errors}}},
      {"transfer.errors.samples", {"", {lasting_thrust, law, errors}}},
      {"transfer.errors.seed", {"", {lasting_thrust, law, errors}}},
      {"thruster.acceleration_m_s2", {"", {no_thruster, weak_thruster}}},
      {"thruster.mass_kg", {"", {}, "50"}},
      {"transfer.waypoint.0.time_s", {"", {waypoint}, "100"}},
      {"transfer.waypoint.0.time_orbits", {"", {waypoint, no_time}, "0.5"}},
      {"transfer.waypoint.0.time_canonical", {"", {waypoint, no_time}, "0.5"}},
      {"transfer.waypoint.0.position_m", {"", {waypoint}, "[0, 1, 0]"}},
      {"transfer.kind", {"", {}, "\"qpq-qqp\""}},
      {"validity.times_s", {"", {no_validity_count}, "[100, 200]"}},
      {"validity.times_orbits", {"", {no_validity_count}}},
      {"validity.times_canonical", {"", {no_validity_count}}},
      {"uncertainty.acceleration_density_m2_s3",
       {"", {{"uncertainty.collision", "null"}, {"uncertainty.safety", "null"}}}},
      {"uncertainty.most_domains", {"", {{"uncertainty.tolerance_m", "2"}}}},
      {"uncertainty.times_s", {"", {no_uncertainty_count}, "[100, 200]"}},
      {"uncertainty.times_orbits", {"", {no_uncertainty_count}}},
      {"uncertainty.times_canonical", {"", {no_uncertainty_count}}},
      {"uncertainty.covariance_m_m_s", {"", {{"uncertainty.position_m", "null"}}, covariance_text}},
      {"uncertainty.parameters",
       {"earth/drag", {{"uncertainty", "{position_m=[1, 1, 1]}"}}, "{density_factor=0.1}"}},
      {"uncertainty.parameter_covariances",
       {"earth/drag",
        {{"uncertainty", "{position_m=[1, 1, 1], parameters={drag_m2_kg=1e-3}}"}},
        "{drag_m2_kg=[1e-4, 0, 0, 0, 0, 0]}"}},
      {"uncertainty.deputy.parameters",
       {"earth/drag",
        {{"uncertainty", "{deputy={position_m=[1, 1, 1]}}"}},
        "{thrust_T_m_s2=1e-9}"}},
      {"uncertainty.deputy.parameter_covariances",
       {"earth/drag",
        {{"uncertainty", "{deputy={position_m=[1, 1, 1], parameters={drag_m2_kg=1e-3}}}"}},
        "{drag_m2_kg=[1e-4, 0, 0, 0, 0, 0]}"}},
      {"uncertainty.file", {"", {{"uncertainty.position_m", "null"}, dated, of_first}, cdm}},
      {"uncertainty.object",
       {"",
        {{"uncertainty.position_m", "null"}, dated, of_second, {"uncertainty.file", cdm}},
        "\"OBJECT2\""}},
      {"uncertainty.deputy.file",
       {"", {{"uncertainty.deputy.position_m", "null"}, dated, of_second, at_chief}, cdm}},
      {"uncertainty.deputy.object",
       {"",
        {{"uncertainty.deputy.position_m", "null"},
         dated,
         of_first,
         at_chief,
         {"uncertainty.deputy.file", cdm}},
        "\"OBJECT1\""}},
      {"uncertainty.deputy.covariance_m_m_s",
       {"", {{"uncertainty.deputy.position_m", "null"}}, covariance_text}},
      {"ephemeris.epoch", {"", {}, "\"2003-01-01T00:00:00\""}},
      {"ephemeris.reference_frame", {"", {}, "\"GCRF\""}},
      {"ephemeris.reference_frame_epoch", {"", {}, "\"2026-01-01T00:00:00\""}},
      {"ephemeris.oem_version", {"", {}, "3.0"}},
      {"canonical_transformation.rotation_angle_rad", {"", {no_rotation}}},
      {"canonical_transformation.matrix", {"", {no_rotation}, matrix.value}},
      {"canonical_transformation.shift", {"", {no_rotation, matrix}, "[1, 2]"}},
      {"energy_conservation.first_step_canonical", {"", {}, "0.03"}},
      {"energy_conservation.first_step_s",
       {"", {{"energy_conservation.first_step_canonical", "null"}}, "100"}},
      {"energy_conservation.duration_s", {"", {no_orbits}, "1e5"}},
      {"energy_conservation.duration_canonical", {"", {no_orbits}}},
      {"optimal_control.problem", {"", {}, "\"double-integrator\""}},
      {"optimal_control.steps", {"", {}, "8"}},
      {"optimal_control.shooting_intervals", {"", {}, "2"}},
      {"optimal_control.start", {"", {}, "[0, 1]"}},
      {"optimal_control.end", {"", {}, "[2]"}},
      {"optimal_control.free_end", {"", {}, "[\"position\"]"}},
      {"optimal_control.costate_guess", {"", {}, "[1, 1]"}}};
  // The forms of a deputy have six keys each, of which one that is left out is 0.
  static const std::map<std::string, Place> places = [] {
    std::map<std::string, Place> all = listed;
    for (const DeputyForm form : nonlinear_forms) {
      const auto& components = components_of(form);
      for (const DeputyComponent& component : components) {
        const auto& other = component.name == components[0].name ? components[1] : components[0];
        const Override rest = {"deputy", fmt::format("{{{} = 20}}", other.name)};
        all[fmt::format("deputy.{}", component.name)] = {"", {no_deputy, rest}, "0.01"};
      }
    }
    return all;
  }();
  return places;
}

}  // namespace hamjet::io
