#include "refused_scene.hpp"

// Scenes with drag with one mistake each.

namespace hamjet::test {
namespace {

using std::string;

const string drag_scene = R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
atmosphere = "harris-priester"
[spacecraft]
mass_kg = 4
area_m2 = 0.03
[nominal]
epoch_utc = "2023-05-16T06:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[jet]
order = 1
duration_s = 600
)";

using BadDrag = RefusedScene;

TEST_F(BadDrag, EachIsOneLine) {
  const std::vector<Mistake> mistakes = {
      {"\"harris-priester\"", "\"harris\"", {"5", "atmosphere", "harris-priester"}},
      {"mass_kg = 4", "mass_kg = 0", {"7", "mass_kg"}},
      {"area_m2 = 0.03", "drag_m2_kg = 0.01", {"7", "mass_kg", "given twice"}},
      {"area_m2 = 0.03\n", "", {"area_m2", "missing"}},
      {"[spacecraft]\nmass_kg = 4\narea_m2 = 0.03\n", "", {"5", "atmosphere", "[spacecraft]"}},
      {"atmosphere = \"harris-priester\"\n", "", {"spacecraft", "without air"}},
      {"[spacecraft]", "bulge_exponent = 3\n[spacecraft]", {"6", "bulge_exponent", "odd"}},
      {"[spacecraft]", "density_factor = -1\n[spacecraft]", {"6", "density_factor"}},
      {"order = 1",
       "order = 1\nvariables = [\"x\", \"drag\"]",
       {"17", "variables", "unknown variable"}},
      {"order = 1",
       "order = 1\nvariables = [\"drag_m2_kg\", \"J5\"]",
       {"17", "beyond the field of degree", "gravity_degree = 5"}},
      {"order = 1",
       "order = 1\nvariables = [\"drag_m2_kg\", \"mu_km3_s2\"]\nsymmetry = \"rotation-and-time\"",
       {"18", "symmetry", "beside the variable drag_m2_kg"}},
      {"order = 1",
       "order = 1\nvariables = [\"drag_m2_kg\"]\ncoordinates = \"spherical\"",
       {"18", "coordinates", "cartesian"}},
      {"duration_s = 600\n",
       "duration_s = 600\n[generating_function]\nkinds = [\"F1\"]\n",
       {"19", "kinds", "despite_drag"}}};
  expect_each_refused(drag_scene, mistakes);
}

TEST_F(BadDrag, OtherModelsHaveNoSpacecraft) {
  write("bad.toml", R"(schema = 1
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[spacecraft]
drag_m2_kg = 0.01
[nominal]
a_km = 7000
e = 0
i_deg = 30
raan_deg = 0
u_deg = 0
[jet]
order = 1
duration_s = 600
)");
  expect_error({"run", "bad.toml"}, 3, {"spacecraft", "earth"});
}

}  // namespace
}  // namespace hamjet::test
