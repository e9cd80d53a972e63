#include <cmath>

#include "scene_samples.hpp"

// The table [units], compensated_summation and the table [case].

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

// What a stability case holds is read by `hamjet stability`; here its keys are known.
TEST(StabilityCase, IsAcceptedInAScene) {
  const std::string text = std::string(state) + "[case]\ngroup = \"Kepler\"\nstate = [\"1\"]\n";
  EXPECT_EQ(parse_scene(text, "x").nominal, parse_scene(state, "x").nominal);
  expect_scene_error(text + "outcom = \"right\"\n", {"case.outcom: unknown key", "outcome"});
}

}  // namespace
}  // namespace hamjet::io
