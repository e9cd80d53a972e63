#include "refused_scene.hpp"

// Scenes with a thruster with one mistake each.

namespace hamjet::test {
namespace {

using std::string;

const string thruster_scene = R"(schema = 1
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 7000
e = 0
i_deg = 50
raan_deg = 0
u_deg = 0
[jet]
order = 1
duration_s = 600
[transfer]
count = 1
start = { position_m = [0, -1000, 0] }
end = { position_m = [0, -100, 0] }
[thruster]
thrust_N = 1
mass_kg = 100
specific_impulse_s = 220
)";

using BadThruster = RefusedScene;

TEST_F(BadThruster, EachIsOneLine) {
  const string right = "thrust_N = 1\nmass_kg = 100\nspecific_impulse_s = 220\n";
  const std::vector<Mistake> mistakes = {
      {right, "", {"18", "thruster", "acceleration_m_s2", "thrust_N"}},
      {"thrust_N = 1", "acceleration_m_s2 = 1\nthrust_N = 1", {"thruster", "thrust_N"}},
      {"thrust_N = 1", "acceleration_m_s2 = 1", {"20", "mass_kg", "beside acceleration_m_s2"}},
      {right, "acceleration_m_s2 = 0", {"19", "acceleration_m_s2", "above 0"}},
      {right, "acceleration_m_s2 = -1", {"19", "acceleration_m_s2", "above 0"}},
      {"thrust_N = 1\nmass_kg = 100", "thrust_N = 1e300\nmass_kg = 1e-300", {"out of range"}},
      {"mass_kg = 100\n", "", {"thruster", "mass_kg", "missing"}},
      {"specific_impulse_s = 220\n", "", {"thruster", "specific_impulse_s", "missing"}},
      {"specific_impulse_s = 220", "specific_impulse_s = \"220\"", {"21", "specific_impulse_s"}},
      {"mass_kg = 100", "mass_kg = 100\npropellant_kg = 100", {"21", "propellant_kg", "less than"}},
      {right,
       "acceleration_m_s2 = 1\npropellant_kg = 1",
       {"20", "propellant_kg", "beside acceleration_m_s2"}},
      {right,
       "acceleration_m_s2 = 1\nlongest_burn_s = 5\nshortest_burn_s = 6",
       {"20", "longest_burn_s", "shortest_burn_s"}},
      {"thrust_N = 1", "thrust_N = 1\nattitude = \"LVLH\"", {"20", "attitude", "inertial"}},
      {"duration_s = 600", "duration_s = -600", {"thruster", "before the start"}},
      {"[transfer]\ncount = 1\nstart = { position_m = [0, -1000, 0] }\n"
       "end = { position_m = [0, -100, 0] }\n",
       "",
       {"thruster", "no table [transfer]"}}};
  expect_each_refused(thruster_scene, mistakes);
}

// What thrust of least fuel needs, and what it does not look at.
TEST_F(BadThruster, OfLeastFuelIsOneLine) {
  const string right = "thrust_N = 1\nmass_kg = 100\nspecific_impulse_s = 220\n";
  const string fuel = "count = 1\nthrust = \"fuel-optimal\"";
  string scene = thruster_scene;
  scene.replace(scene.find("count = 1"), 9, fuel);
  const std::vector<Mistake> mistakes = {
      {right, "acceleration_m_s2 = 1\nattitude = \"RTN\"", {"21", "attitude", "must be left out"}},
      {right,
       "acceleration_m_s2 = 1\nlongest_burn_s = 5",
       {"21", "longest_burn_s", "must be left out"}},
      {"[thruster]\n" + right, "", {"16", "thrust", "no table [thruster]"}}};
  expect_each_refused(scene, mistakes);
  scene.replace(scene.find(right), right.size(), "acceleration_m_s2 = 1\n");
  expect_each_refused(scene, {{"thrust = \"fuel-optimal\"",
                               "thrust = \"fuel-optimal\"\nlargest_thrust_m_s2 = 1",
                               {"17", "largest_thrust_m_s2", "must be left out"}}});
}

}  // namespace
}  // namespace hamjet::test
