#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "../scene/scene_samples.hpp"
#include "comparison_samples.hpp"
#include "hamjet/report/comparison_report.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/descriptions/settings_fields.hpp"

// Everything that a scene says must be in the results. Every member of the settings is listed here
// with the lines of a scene that give it a value of its own and with the expected JSON; a member
// that is not listed fails the test.

namespace hamjet::io {
namespace {

using OrderedJson = nlohmann::ordered_json;

struct Written {
  std::string lines;  ///< keys of the member's table
  OrderedJson value;
};
using WrittenFields = std::map<std::string_view, Written>;

template <class Settings>
std::vector<std::string_view> field_names() {
  Settings settings;
  std::vector<std::string_view> names;
  for_each_field(settings, [&](std::string_view name, auto&) { names.push_back(name); });
  return names;
}

OrderedJson comparison_of(const Scene& scene) {
  ComparisonResult result = sample_comparison();
  result.scene = scene;
  result.runs.resize(1);
  result.runs[0].settings = scene.integrators[0];
  return OrderedJson::parse(comparison_json(result, sample_origin()));
}

TEST(SettingsJson, EveryMemberOfAnIntegratorComesFromTheSceneAndIsReadBack) {
  const WrittenFields fields = {
      {"label", {"label = \"mine\"\nmethod = \"gauss\"\ntolerance = 1e-9", "mine"}},
      {"method", {"label = \"a\"\nmethod = \"fehlberg78\"\ntolerance = 1e-9", "fehlberg78"}},
      {"stages", {"label = \"a\"\nmethod = \"gauss\"\ntolerance = 1e-9\nstages = 5", 5}},
      {"order",
       {"label = \"a\"\nmethod = \"velocity-verlet\"\nstep_canonical = 0.1\norder = 6", 6}},
      {"beta", {"label = \"a\"\nmethod = \"newmark\"\nstep_canonical = 0.1\nbeta = 0.125", 0.125}},
      {"compensated_summation",
       {"label = \"a\"\nmethod = \"gauss\"\ntolerance = 1e-9\ncompensated_summation = false",
        false}},
      {"step_canonical", {"label = \"a\"\nmethod = \"gauss\"\nstep_canonical = 0.2", 0.2}},
      {"tolerance", {"label = \"a\"\nmethod = \"gauss\"\ntolerance = 3e-9", 3e-9}},
      {"require_relative_error",
       {"label = \"a\"\nmethod = \"gauss\"\ntolerance = 1e-9\nrequire_relative_error = 1e-3",
        1e-3}},
      {"require_symplecticity",
       {"label = \"a\"\nmethod = \"gauss\"\ntolerance = 1e-9\nrequire_symplecticity = 1e-5",
        1e-5}}};
  std::string head = oscillator;
  head.resize(head.find("[[integrator]]"));
  const OrderedJson plain = comparison_of(parse_scene(
      head + "[[integrator]]\nlabel = \"a\"\nmethod = \"gauss\"\nstep_canonical = 0.1\n", "a"));
  for (const std::string_view name : field_names<IntegratorSettings>()) {
    SCOPED_TRACE(std::string(name));
    ASSERT_TRUE(fields.contains(name));
    const Written& field = fields.at(name);
    const Scene scene = parse_scene(head + "[[integrator]]\n" + field.lines + "\n", "a");
    const OrderedJson json = comparison_of(scene);
    const std::string key(name);
    EXPECT_EQ(json["scene"]["integrators"][0][key], field.value);
    EXPECT_NE(plain["scene"]["integrators"][0][key], field.value) << "the value is the default";
    ComparisonResult again = sample_comparison();
    again.scene = scene;
    again.runs = read_comparison_runs(json.dump()).runs;
    EXPECT_EQ(OrderedJson::parse(comparison_json(again, sample_origin()))["runs"], json["runs"]);
    EXPECT_EQ(json["runs"][0]["settings"][key], field.value);
  }
}

TEST(SettingsJson, EveryMemberOfAComparisonComesFromTheScene) {
  const WrittenFields fields = {{"methods", {"methods = [\"newmark\"]", {"newmark"}}},
                                {"stages", {"stages = [3]", {3}}},
                                {"steps_canonical", {"steps_canonical = [0.5]", {0.5}}},
                                {"tolerances", {"tolerances = [1e-5]", {1e-5}}},
                                {"orders", {"orders = [1]", {1}}},
                                {"repeats", {"repeats = 7", 7}},
                                {"time_budget_s", {"time_budget_s = 60", 60}},
                                {"wanted_error_m", {"wanted_error_m = 5", 5}}};
  const OrderedJson plain = comparison_of(parse_scene(oscillator, "a"));
  for (const std::string_view name : field_names<ComparisonSettings>()) {
    SCOPED_TRACE(std::string(name));
    ASSERT_TRUE(fields.contains(name));
    const Written& field = fields.at(name);
    const OrderedJson json =
        comparison_of(parse_scene(oscillator + "[compare]\n" + field.lines, "a"));
    EXPECT_EQ(json["scene"]["compare"][std::string(name)], field.value);
    EXPECT_NE(plain["scene"]["compare"][std::string(name)], field.value);
  }
}

/// `system` of summary.json.
OrderedJson summary_system(const Scene& scene) {
  return OrderedJson::parse(summary_json(propagate(scene, {}, 1)))["system"];
}

TEST(SettingsJson, EveryMemberOfASystemComesFromTheScene) {
  const std::string orbit_end =
      "[nominal]\nposition_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n";
  const std::string pair_end = "[nominal]\nposition_m = [1, 2]\nmomentum_kg_m_s = [0, 0]\n";
  const std::string zonal = "model = \"zonal-gravity\"\nmu_km3_s2 = 398600\nradius_km = 6400\n";
  const std::string pendulum =
      "model = \"spring-pendulum\"\nmass_kg = 2\nstiffness_N_per_m = 3\nlength_m = 4\n"
      "gravity_m_s2 = 9\n";
  const std::string chain = "model = \"fermi-pasta-ulam\"\nomega_rad_per_s = 5\npairs = 1\n";
  const std::string file = std::string("model = \"zonal-gravity\"\ngravity_file = \"") +
                           HAMJET_SOURCE_DIR +
                           "/data/gravity/EGM96-zonals.gfc\"\n"
                           "highest_zonal = 2\n";
  const std::string own =
      "model = \"own\"\ncoordinates = [\"x\", \"y\"]\nmomenta = [\"u\", \"v\"]\n"
      "hamiltonian = \"u^2/2 + v^2/2 - x*y\"\n";
  const std::string own_end = "[nominal]\ncoordinates = [1, 2]\nmomenta = [0, 0]\n";
  struct Place {
    std::string table;
    std::string nominal;
    std::string pointer;
    OrderedJson value;
  };
  const std::map<std::string_view, Place> places = {
      {"mu_km3_s2", {zonal + "J2 = 1e-3", orbit_end, "/mu_km3_s2", 398600}},
      {"radius_km", {zonal + "J2 = 1e-3", orbit_end, "/radius_km", 6400}},
      {"J", {zonal + "J20 = 1e-7", orbit_end, "/zonal_coefficients/J20", 1e-7}},
      {"mass_kg", {pendulum, pair_end, "/mass_kg", 2}},
      {"stiffness_N_per_m", {pendulum, pair_end, "/stiffness_N_per_m", 3}},
      {"second_stiffness_N_per_m",
       {"model = \"oscillator-pair\"\nstiffness_N_per_m = [2, 3]\n", pair_end,
        "/stiffness_N_per_m/1", 3}},
      {"length_m", {pendulum, pair_end, "/length_m", 4}},
      {"gravity_m_s2", {pendulum, pair_end, "/gravity_m_s2", 9}},
      {"omega_rad_per_s", {chain, pair_end, "/omega_rad_per_s", 5}},
      {"pairs", {chain, pair_end, "/pairs", 1}},
      {"gravity_file", {file, orbit_end, "/gravity_file/model_name", "EGM96"}},
      // The coordinates' names say how many there are.
      {"own_degrees_of_freedom", {own, own_end, "/coordinates", {"x", "y"}}},
      {"own_names", {own, own_end, "/momenta", {"u", "v"}}},
      {"own_text", {own, own_end, "/hamiltonian", "u^2/2 + v^2/2 - x*y"}},
      {"earth",
       {"model = \"earth\"\ngravity_degree = 7\n",
        orbit_end + "epoch_tt = \"2026-03-01T06:00:00\"\n", "/earth/gravity_degree", 7}}};
  for (const std::string_view name : field_names<SystemSettings>()) {
    if (name == "model") continue;  // at the top of the file
    SCOPED_TRACE(std::string(name));
    ASSERT_TRUE(places.contains(name));
    const Place& place = places.at(name);
    const Scene scene =
        parse_scene("schema = 1\ntitle = \"a\"\n[system]\n" + place.table + "\n" + place.nominal +
                        "[jet]\norder = 1\nduration_canonical = 0.1\n[[integrator]]\nlabel = "
                        "\"a\"\nmethod = \"gauss\"\ntolerance = 1e-6\n",
                    "a");
    EXPECT_EQ(summary_system(scene)[OrderedJson::json_pointer(place.pointer)], place.value);
  }
}

}  // namespace
}  // namespace hamjet::io
