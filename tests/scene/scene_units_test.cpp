#include <cmath>

#include "scene_samples.hpp"
#include "study_text.hpp"

// Tests the table [units], compensated_summation and the table [case].

namespace hamjet::io {
namespace {

constexpr const char* state = R"(schema = 1
title = "state"
[system]
model = "zonal-gravity"
mu_km3_s2 = 1
radius_km = 0.7
J2 = 1e-3
[units]
length_km = 1
[nominal]
position_km = [0.1, -0.0, 5e-324]
velocity_km_s = [1e-300, 3.3, -0.7]
[jet]
order = 2
duration_s = 0.3
[[integrator]]
label = "a"
method = "gauss"
step_s = 0.1
compensated_summation = false
)";

// With units of 1 km and 1 s nothing is changed by a conversion, not even a denormal or a sign.
TEST(SceneUnits, OfOneKeepTheScenesNumbers) {
  const Scene scene = parse_scene(state, "x");
  EXPECT_EQ(scene.nominal, (std::vector<double>{0.1, -0.0, 5e-324, 1e-300, 3.3, -0.7}));
  EXPECT_TRUE(std::signbit(scene.nominal[1]));
  EXPECT_EQ(scene.units.length_km, 1);
  EXPECT_EQ(scene.units.time_s, 1);
  EXPECT_EQ(scene.canonical_radius, 0.7);
  EXPECT_EQ(scene.duration, 0.3);
  EXPECT_EQ(scene.integrators[0].step_canonical, 0.1);
}

// Units of 4 km: the unit of time is sqrt(64 / mu) = 4 s with mu = 4, of velocity 1 km/s. Without
// the table the distance of 8 km is the unit.
TEST(SceneUnits, AreTheChosenLengthAndMuOfOne) {
  const std::string text = changed(
      changed(changed(state, "mu_km3_s2 = 1", "mu_km3_s2 = 4"), "length_km = 1", "length_km = 4"),
      "[0.1, -0.0, 5e-324]", "[8, 0, 0]");
  const Scene scene = parse_scene(text, "x");
  EXPECT_EQ(scene.units.length_km, 4);
  EXPECT_EQ(scene.units.time_s, 4);
  EXPECT_EQ(scene.nominal, (std::vector<double>{2, 0, 0, 1e-300, 3.3, -0.7}));
  EXPECT_EQ(scene.duration, 0.3 / 4);
  const Scene own = parse_scene(changed(text, "[units]\nlength_km = 4\n", ""), "x");
  EXPECT_EQ(own.units.length_km, 8);
  EXPECT_EQ(own.nominal[0], 1);
}

/// An orbit with every table that has times or lengths, none of them canonical.
constexpr const char* of_all_tables = R"(schema = 1
title = "all"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1e-3
[nominal]
a_km = 26600
e = 0.3
i_deg = 63.4
raan_deg = 20
argp_deg = 270
ta_deg = 30
[jet]
order = 2
duration_orbits = 0.7
[[integrator]]
label = "a"
method = "gauss"
step_s = 60
[formation]
separation_km = 1
[deputy]
a_km = 26600.5
e = 0.3
i_deg = 63.4
raan_deg = 20
argp_deg = 270
ta_deg = 30
[transfer]
impulse_gap_s = 100
times_orbits = [0.3, 0.6]
[transfer.end]
position_m = [0, 10, 0]
[validity]
tolerance_m = 1
count = 3
[uncertainty]
times_s = [600, 1200]
position_m = [1, 1, 1]
velocity_m_s = [1e-3, 1e-3, 1e-3]
[uncertainty.collision]
radius_m = 10
window_s = [100, 2000]
[event]
surface = "distance"
distance_km = 26000
[bounded]
sizes_km = [1]
)";

// The printed digits of a number give back the same number.
TEST(SceneUnits, OfTheChiefLeaveNothingOfTheTable) {
  const auto text_of = [](const std::string& text, SceneUnits units) {
    Scene scene = parse_scene(text, "x", {}, units);
    EXPECT_EQ(scene.told_units.has_value(), text != of_all_tables);
    StudyText result;
    result.add(scene);
    return result.text();
  };
  const std::string own = text_of(of_all_tables, SceneUnits::chiefs);
  EXPECT_EQ(text_of(of_all_tables, SceneUnits::told), own);
  for (const char* length_km : {"0.001", "1", "6378.1363", "149597870.7"}) {
    const std::string text =
        std::string(of_all_tables) + "[units]\nlength_km = " + length_km + "\n";
    EXPECT_EQ(text_of(text, SceneUnits::chiefs), own) << length_km;
    EXPECT_NE(text_of(text, SceneUnits::told), own) << length_km;
  }
}

// The chief's own unit of length is 8 km, and of time 8^(3/2) / 2 s with mu = 4. The requested
// units are 2 km and 2^(3/2) / 2 s: a time is an eighth of the given number, a length a quarter.
TEST(SceneUnits, OfTheChiefTakeCanonicalTimesFromThoseThatAreTold) {
  std::string text =
      changed(changed(state, "mu_km3_s2 = 1", "mu_km3_s2 = 4"), "[0.1, -0.0, 5e-324]", "[8, 0, 0]");
  text = changed(changed(text, "length_km = 1", "length_km = 2"), "duration_s = 0.3",
                 "duration_canonical = 8");
  text = changed(text, "step_s = 0.1", "step_canonical = 4") +
         "[relative_hamiltonian]\ntimes_canonical = [2, 8]\n[compare]\nsteps_canonical = [4]\n" +
         "[validity]\ntimes_canonical = [4, 8]\ntolerance_m = 1\n";
  const Scene scene = parse_scene(text, "x", {}, SceneUnits::chiefs);
  EXPECT_EQ(scene.units.length_km, 8);
  EXPECT_EQ(scene.nominal[0], 1);
  EXPECT_EQ(scene.canonical_radius, 0.7 / 8);
  EXPECT_EQ(scene.duration, 1);
  EXPECT_EQ(scene.integrators[0].step_canonical, 0.5);
  EXPECT_EQ(scene.relative_hamiltonian_times, (std::vector<double>{0.25, 1}));
  EXPECT_EQ(scene.comparison.steps_canonical, std::vector<double>{0.5});
  EXPECT_EQ(scene.validity->times, (std::vector<double>{0.5, 1}));
  ASSERT_TRUE(scene.told_units);
  EXPECT_EQ(scene.told_units->length_km, 2);
  const CanonicalFactors told = told_factors(scene);
  EXPECT_EQ(told.length, 4);
  EXPECT_NEAR(told.time, 8, 1e-14);
  EXPECT_NEAR(told.momentum, 0.5, 1e-15);
  EXPECT_NEAR(told_time(scene, scene.duration), 8, 1e-14);
  EXPECT_EQ(told_state(scene, {1, 0, 0, 0, 0, 0})[0], 4);
  // Errors quote the numbers as they were given.
  try {
    parse_scene(changed(text, "[2, 8]", "[2, 9]"), "x", {}, SceneUnits::chiefs);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the duration of 8"), std::string::npos)
        << error.what();
  }
}

TEST(SceneUnits, BadInput) {
  const auto refuse = [](const char* from, const char* to, const std::vector<std::string>& words) {
    expect_scene_error(changed(state, from, to), words);
  };
  refuse("length_km = 1", "length_km = 0", {"units.length_km: not positive"});
  refuse("length_km = 1", "length_m = 1", {"units.length_m: unknown key", "length_km"});
  refuse("length_km = 1\n", "", {"units.length_km: missing"});
  refuse("length_km = 1", "length_km = 1e-250", {"nominal: out of range", "1e-250 km"});
  refuse("[0.1, -0.0, 5e-324]", "[0, -0.0, 5e-324]",
         {"nominal: out of range", "a distance of 4.94e-324", "between 1e-09 and 1e+09"});
  expect_scene_error(oscillator + "[units]\nlength_km = 1\n",
                     {"units: not available for the model harmonic-oscillator"});
}

TEST(CompensatedSummation, IsOnUnlessAGaussMethodSaysNot) {
  EXPECT_FALSE(parse_scene(state, "x").integrators[0].compensated_summation);
  EXPECT_TRUE(parse_scene(orbit, "x").integrators[0].compensated_summation);
  expect_scene_error(changed(state, "summation = false", "summation = 0"),
                     {"compensated_summation: wrong type", "true or false"});
  expect_scene_error(changed(state, "\"gauss\"", "\"fehlberg78\""),
                     {"the method fehlberg78 has no key"});
}

// `hamjet stability` reads the contents of a stability case; here only its keys are known.
TEST(StabilityCase, IsAcceptedInAScene) {
  const std::string text = std::string(state) + "[case]\ngroup = \"Kepler\"\nstate = [\"1\"]\n";
  EXPECT_EQ(parse_scene(text, "x").nominal, parse_scene(state, "x").nominal);
  expect_scene_error(text + "outcom = \"right\"\n", {"case.outcom: unknown key", "outcome"});
}

}  // namespace
}  // namespace hamjet::io
