#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "scene/study_reader.hpp"
#include "scene/tables/key_reference.hpp"
#include "scene/tables/table_description.hpp"
#include "scene_samples.hpp"
#include "study_text.hpp"
#include "sweep/sweep_tables.hpp"

// What the tables declare of their keys is what the readers do: every key is taken, a value just
// outside its range is refused, and leaving it out is its default. The scenes are those that are
// shipped, changed as with --set.

namespace hamjet::io {
namespace {

/// A key in a scene that can have it.
struct Place {
  std::string file = {};  ///< empty: that of the table
  std::vector<Override> changes = {};
  std::string value = {};  ///< empty: made from the key's form
};

/// Where the keys of a table, or of one owner of its keys, stand.
Place place_of(const std::string& table, std::string_view owner) {
  static const std::string orbit_file = "transfer-sun-synchronous";
  static const std::string oscillator = "paper/harmonic-oscillator";
  static const Override plane = {"nominal", "{position_m=[1, 1], momentum_kg_m_s=[0, 0]}"};
  static const std::map<std::string, Place, std::less<>> of_models = {
      {"kepler", {orbit_file, {{"system", "{model=\"kepler\", mu_km3_s2=4e5}"}}}},
      {"harmonic-oscillator", {oscillator}},
      {"oscillator-pair",
       {oscillator, {plane, {"system", "{model=\"oscillator-pair\", stiffness_N_per_m=[1, 2]}"}}}},
      {"spring-pendulum",
       {oscillator,
        {plane,
         {"system",
          "{model=\"spring-pendulum\", stiffness_N_per_m=1, length_m=1, gravity_m_s2=1}"}}}},
      {"fermi-pasta-ulam",
       {oscillator,
        {plane, {"system", "{model=\"fermi-pasta-ulam\", omega_rad_per_s=1, pairs=1}"}}}}};
  static const std::map<std::string, Place, std::less<>> of_tables = {
      {"formation", {orbit_file, {{"formation", "{separation_km=1}"}}}},
      {"deputy", {orbit_file, {{"deputy", "{position_m=[0, 100, 0]}"}}}},
      {"bounded", {orbit_file, {{"bounded", "{}"}}}},
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
          "collision={radius_m=5}}"}}}},
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
  if (owner == other_models) return {oscillator};
  if (const auto model = of_models.find(owner); model != of_models.end()) return model->second;
  static const std::set<std::string> left_out = {
      "units",  "generating_function", "output", "relative_hamiltonian",
      "checks", "reference",           "compare"};
  if (left_out.contains(table)) return {orbit_file, {{table, "{}"}}};
  const auto own = of_tables.find(table.substr(0, table.find('.')));
  return own != of_tables.end() ? own->second : Place{orbit_file};
}

/// What the keys need besides whose values or surroundings do not follow from their forms.
const std::map<std::string, Place>& special_places() {
  static const Override no_duration = {"jet.duration_orbits", "null"};
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
  static const Override no_time = {"transfer.waypoint.0.time_s", "null"};
  static const std::map<std::string, Place> listed = {
      {"uncertainty.collision.window_s", {"", {}, "[1, 2]"}},
      {"system.gravity_file", {"", {field, highest}, "\"../gravity/EGM96-zonals.gfc\""}},
      {"system.highest_zonal", {"", {field}}},
      {"system.zonals", {"", {field}}},
      {"system.gravity_epoch", {"", {field, highest}, "\"2005-01-01T00:00:00\""}},
      {"system.leave_out_C10", {"", {field, highest}}},
      {"system.pairs", {"", {}, "1"}},
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
      {"transfer.waypoint.0.time_s", {"", {waypoint}, "100"}},
      {"transfer.waypoint.0.time_orbits", {"", {waypoint, no_time}, "0.5"}},
      {"transfer.waypoint.0.time_canonical", {"", {waypoint, no_time}, "0.5"}},
      {"transfer.waypoint.0.position_m", {"", {waypoint}, "[0, 1, 0]"}},
      {"transfer.kind", {"", {}, "\"qpq-qqp\""}},
      {"validity.times_s", {"", {no_validity_count}, "[100, 200]"}},
      {"validity.times_orbits", {"", {no_validity_count}}},
      {"validity.times_canonical", {"", {no_validity_count}}},
      {"uncertainty.times_s", {"", {no_uncertainty_count}, "[100, 200]"}},
      {"uncertainty.times_orbits", {"", {no_uncertainty_count}}},
      {"uncertainty.times_canonical", {"", {no_uncertainty_count}}},
      {"uncertainty.covariance_m_m_s", {"", {{"uncertainty.position_m", "null"}}, covariance_text}},
      {"uncertainty.file", {"", {{"uncertainty.position_m", "null"}, dated}, cdm}},
      {"uncertainty.object",
       {"", {{"uncertainty.position_m", "null"}, dated, {"uncertainty.file", cdm}}, "\"OBJECT2\""}},
      {"uncertainty.deputy.file", {"", {{"uncertainty.deputy.position_m", "null"}, dated}, cdm}},
      {"uncertainty.deputy.object",
       {"",
        {{"uncertainty.deputy.position_m", "null"}, dated, {"uncertainty.deputy.file", cdm}},
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

std::string in_array(const ValueForm& form, const std::string& value) {
  if (!form.is_array) return value;
  std::string array = value;
  for (std::size_t i = 1; i < form.count; ++i) array += ", " + value;
  return '[' + array + ']';
}

std::string number_text(const ValueForm& form, double value) {
  return form.type == ValueForm::Type::integer ? fmt::format("{:.0f}", value)
                                               : fmt::format("{:e}", value);
}

/// A value of the form.
std::string right_value(const ValueForm& form) {
  if (form.type == ValueForm::Type::boolean) return "true";
  if (!form.choices.empty()) return in_array(form, fmt::format("\"{}\"", form.choices[0]));
  if (form.type == ValueForm::Type::text) return in_array(form, "\"text\"");
  return in_array(form, form.has_range() ? number_text(form, form.most) : "1");
}

/// Values just outside what the form declares.
std::vector<std::string> wrong_values(const ValueForm& form) {
  std::vector<std::string> values;
  if (form.type == ValueForm::Type::boolean) values = {"1", "\"true\""};
  if (form.type == ValueForm::Type::text) values = {"1"};
  if (!form.choices.empty()) values.emplace_back("\"none of them\"");
  if (form.is_positive) values = {"0", "-1e-300"};
  if (form.has_range()) {
    const bool is_integer = form.type == ValueForm::Type::integer;
    const auto beyond = [&](double bound, double sign) {
      return is_integer ? number_text(form, bound + sign)
                        : fmt::format("{:.17g}", std::nextafter(bound, sign * INFINITY));
    };
    values.push_back(beyond(form.least, -1));
    if (form.most < std::numeric_limits<double>::max()) values.push_back(beyond(form.most, 1));
    if (is_integer) values.emplace_back("1.5");
  }
  if (form.type == ValueForm::Type::number) values.emplace_back("inf");
  for (std::string& value : values) value = in_array(form, value);
  return values;
}

/// The study as a text, or the message where it is refused, behind "refused: ".
std::string read(const Place& place, const std::string& key, const std::string& value) {
  std::vector<Override> overrides = place.changes;
  overrides.push_back({key, value});
  const std::string file = std::string(HAMJET_SOURCE_DIR) + "/data/scenes/" + place.file + ".toml";
  try {
    StudyText text;
    std::visit([&](const auto& study) { text.add(study); }, read_study(file, overrides));
    return text.text();
  } catch (const Error& error) {
    return std::string("refused: ") + error.what();
  }
}

void check_key(const SceneKey& key, const std::string& table, std::string_view owner) {
  const std::string path =
      table.empty() ? std::string(key.name) : fmt::format("{}.{}", table, key.name);
  SCOPED_TRACE(fmt::format("{} ({})", path, owner));
  Place place = place_of(table, owner);
  if (const auto special = special_places().find(path); special != special_places().end()) {
    if (!special->second.file.empty()) place = {special->second.file};
    place.changes = joined<Override>({place.changes, special->second.changes});
    place.value = special->second.value;
  }
  const std::string value = place.value.empty() ? right_value(key.form) : place.value;
  EXPECT_FALSE(read(place, path, value).starts_with("refused")) << read(place, path, value);
  for (const std::string& wrong : wrong_values(key.form)) {
    const std::string said = read(place, path, wrong);
    EXPECT_TRUE(said.starts_with("refused: --set " + path)) << wrong << " gives " << said;
  }
  const std::string without = read(place, path, "null");
  if (key.absence.meaning == Absence::Meaning::refused) {
    EXPECT_TRUE(without.starts_with("refused")) << "it can be left out";
  } else if (key.absence.meaning == Absence::Meaning::value) {
    EXPECT_FALSE(without.starts_with("refused")) << without;
    EXPECT_EQ(read(place, path, key.absence.text), without) << "with the default";
  }
}

void check_keys(const TableDescription& table, const std::string& path,
                std::set<const TableDescription*>& checked) {
  for (const SceneKey& key : table.keys) {
    EXPECT_FALSE(key.help.empty() && key.owners.empty()) << path << ": " << key.name;
    // The other deputies are read as [deputy] is.
    const bool is_of_deputy = special_places().contains(fmt::format("deputy.{}", key.name));
    const bool is_of_nominal = path == "nominal" || !key.owners.empty();
    if (is_of_deputy && !is_of_nominal && path != "deputy") continue;
    if (key.form.table != nullptr) {
      // Other commands than `stability` do not look into this one.
      if (key.name == "case" || !checked.insert(key.form.table).second) continue;
      const std::string below = path + std::string(path.empty() ? "" : ".") + std::string(key.name);
      check_keys(*key.form.table, key.form.is_array ? below + ".0" : below, checked);
    } else if (key.owners.empty()) {
      check_key(key, path, "");
    } else {
      for (const std::string_view owner : key.owners) check_key(key, path, owner);
    }
  }
}

TEST(SceneKeys, TheReadersDoWhatTheTablesDeclare) {
  std::set<const TableDescription*> checked;
  for (const StudyDescription& study : all_studies()) {
    if (!checked.empty()) {
      for (const SceneKey& key : study.top.keys) {
        if (key.form.table != nullptr && checked.insert(key.form.table).second) {
          check_keys(*key.form.table, std::string(key.name), checked);
        }
      }
      continue;
    }
    check_keys(study.top, "", checked);
  }
}

std::string content_of(const std::string& name) {
  std::ifstream file(std::string(HAMJET_SOURCE_DIR) + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SceneKeys, ThePageHasThem) {
  EXPECT_TRUE(content_of("data/scenes/keys/README.md") == key_reference(sweep_study_table()))
      << "renew it by: hamjet list keys > data/scenes/keys/README.md";
}

/// Names of all keys of a table and of those below.
void add_names(const TableDescription& table, std::set<std::string_view>& names) {
  for (const SceneKey& key : table.keys) {
    names.insert(key.name);
    if (key.form.table != nullptr) add_names(*key.form.table, names);
  }
}

TEST(SceneKeys, TheDictionaryOfTheFuzzTargetHasThem) {
  std::set<std::string_view> names;
  for (const StudyDescription& study : all_studies()) add_names(study.top, names);
  const std::string dictionary = content_of("tests/fuzz/scene_text.dict");
  for (const std::string_view name : names) {
    EXPECT_NE(dictionary.find(fmt::format("\n\"{}\"\n", name)), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hamjet::io
