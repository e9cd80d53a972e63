#include "refused_scene.hpp"

// Scenes with radiation pressure with one mistake each.

namespace hamjet::test {
namespace {

using std::string;

const string radiation_scene = R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
radiation = true
[spacecraft]
mass_kg = 2000
area_m2 = 40
[nominal]
epoch_utc = "2023-05-16T06:00:00"
height_km = 35786
i_deg = 1
raan_deg = 30
u_deg = 0
[jet]
order = 1
duration_s = 600
)";

using BadRadiation = RefusedScene;

TEST_F(BadRadiation, EachIsOneLine) {
  const std::vector<Mistake> mistakes = {
      {"radiation = true", "radiation = true\nsun = false", {"5", "radiation", "without the Sun"}},
      {"radiation = true", "radiation = 1", {"5", "radiation"}},
      {"radiation = true", "radiation = true\nshadow = \"cylinder\"", {"6", "shadow", "conical"}},
      {"radiation = true", "shadow = \"none\"", {"5", "shadow", "radiation = true"}},
      {"radiation = true\n", "", {"spacecraft", "without air or light"}},
      {"[spacecraft]\nmass_kg = 2000\narea_m2 = 40\n", "", {"5", "radiation", "[spacecraft]"}},
      {"area_m2 = 40\n", "", {"area_m2", "missing"}},
      {"mass_kg = 2000\n", "", {"mass_kg", "missing"}},
      {"mass_kg = 2000", "radiation_m2_kg = 0.02", {"8", "area_m2", "given twice"}},
      {"area_m2 = 40", "radiation_m2_kg = 0.02", {"7", "mass_kg", "given twice"}},
      {"mass_kg = 2000\narea_m2 = 40",
       "radiation_m2_kg = 0.02\nreflection_coefficient = 1.2",
       {"8", "reflection_coefficient", "given twice"}},
      {"mass_kg = 2000\narea_m2 = 40", "radiation_m2_kg = -0.02", {"7", "negative"}},
      {"area_m2 = 40", "area_m2 = 40\nreflection_coefficient = 3", {"9", "reflection_coefficient"}},
      {"area_m2 = 40", "area_m2 = 40\ndrag_coefficient = 2", {"9", "without air"}},
      {"order = 1", "order = 1\nvariables = [\"drag_m2_kg\"]", {"17", "without air"}},
      {"order = 1",
       "order = 1\nvariables = [\"x\", \"radiation\"]",
       {"17", "variables", "unknown variable"}}};
  expect_each_refused(radiation_scene, mistakes);
}

// Drag and light are two variables of the chief's polynomials, which are flown beside the deputy.
TEST_F(BadRadiation, DeputiesThatDifferInBothAreServedByMotion) {
  string scene = radiation_scene;
  scene.replace(scene.find("height_km = 35786"), 17, "height_km = 500");
  scene.replace(scene.find("[spacecraft]"), 12, "atmosphere = \"exponential\"\n[spacecraft]");
  write(
      "both.toml",
      scene + "[deputy]\nposition_m = [0, 10, 0]\nspacecraft = { mass_kg = 2000, area_m2 = 41 }\n");
  succeed({"motion", "both.toml"});
}

}  // namespace
}  // namespace hamjet::test
