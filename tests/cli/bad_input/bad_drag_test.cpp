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

TEST_F(BadDrag, TablesOfDensities) {
  const string arrays =
      "heights_km = [300, 400, 500, 600]\ndensities_kg_m3 = [2e-11, 3e-12, 5e-13, "
      "1e-13]\n";
  const string table = "atmosphere = \"table\"\n";
  const string right = changed(drag_scene, "atmosphere = \"harris-priester\"\n", table + arrays);
  write("good.toml", right);
  succeed({"check", "good.toml"});
  expect_each_refused(
      right,
      {{arrays, "", {"5", "atmosphere", "no densities", "density_file"}},
       {"heights_km = [300, 400, 500, 600]\n", "", {"6", "densities_kg_m3", "half of a table"}},
       {table, "atmosphere = \"exponential\"\n", {"6", "heights_km", "without a table"}},
       {table, "", {"5", "heights_km", "without air"}},
       {arrays, arrays + "density_file = \"air.csv\"\n", {"6", "heights_km", "given twice"}},
       {"500, 600]", "500]", {"6", "heights_km", "as many densities as heights, got 4 and 3"}},
       {arrays,
        "heights_km = [100, 200]\ndensities_kg_m3 = [5e-7, 3e-10]\n",
        {"6", "at least 4 heights"}},
       {"400, 500", "500, 400", {"6", "must increase", "500 km is followed by 400 km"}},
       {"3e-12", "-3e-12", {"7", "densities_kg_m3"}},
       {"3e-12", "nan", {"7", "densities_kg_m3"}}});
  const string of_file = changed(right, arrays, "density_file = \"air.csv\"\n");
  write("file.toml", of_file);
  expect_error({"check", "file.toml"}, 5, {"file.toml:6", "density_file", "cannot be read"});
  write("air.csv", "height_m,density_kg_m3\n100,5e-7\n");
  expect_error({"check", "file.toml"}, 5, {"air.csv", "height_km"});
  write("air.csv", "height_km,density_kg_m3\n100,5e-7\n200,x\n300,1e-11\n400,1e-12\n");
  expect_error({"check", "file.toml"}, 5, {"air.csv:3", "density_kg_m3"});
  write("air.csv", "height_km,density_kg_m3\n100,5e-7\n200,1e-10\n200,1e-11\n400,1e-12\n");
  expect_error({"check", "file.toml"}, 3, {"file.toml:6", "must increase"});
}

TEST_F(BadDrag, OtherUnitsAreWarnedOf) {
  const auto expect_warned = [&](const string& from, const string& to,
                                 const std::vector<string>& words) {
    write("odd.toml", changed(drag_scene, from, to));
    const string said = in_one_line(hamjet({"check", "odd.toml"}).err);
    for (const string& word : words) EXPECT_NE(said.find(word), string::npos) << said;
  };
  expect_warned("area_m2 = 0.03", "area_m2 = 300", {"area_m2", "is the area in cm^2"});
  // An m / (C_D A) of 60 kg/m^2.
  expect_warned("mass_kg = 4\narea_m2 = 0.03", "drag_m2_kg = 60",
                {"drag_m2_kg", "or the coefficient kg/m^2"});
  expect_warned("\"harris-priester\"",
                "\"table\"\nheights_km = [1e5, 2e5, 3e5, 4e5]\n"
                "densities_kg_m3 = [5e-7, 3e-10, 2e-11, 4e-12]",
                {"heights_km", "are they in metres"});
  expect_warned("\"harris-priester\"",
                "\"table\"\nheights_km = [100, 200, 300, 400]\n"
                "densities_kg_m3 = [497400, 255.7, 17.08, 2.249]",
                {"heights_km", "densities in g/km^3"});
}

// A balloon 200 km up comes down within hours; one 140 km up without much drag stays for the ten
// minutes of its scene.
TEST_F(BadDrag, DecayIsWarnedOf) {
  const string balloon = changed(changed(changed(drag_scene, "area_m2 = 0.03", "area_m2 = 0.3"),
                                         "height_km = 514", "height_km = 200"),
                                 "duration_s = 600", "duration_s = 40000");
  write("balloon.toml", balloon);
  const string said = in_one_line(hamjet({"check", "balloon.toml"}).err);
  EXPECT_NE(
      said.find("balloon.toml:9:1: nominal: the chief decays, got one that is down to 100 km"),
      string::npos)
      << said;
  write("low.toml", changed(drag_scene, "height_km = 514", "height_km = 140"));
  const string low = in_one_line(hamjet({"check", "low.toml"}).err);
  EXPECT_NE(low.find("nominal: low, got a perigee 140 km high"), string::npos) << low;
  EXPECT_EQ(low.find("decays"), string::npos) << low;
  write("deputy.toml",
        changed(drag_scene, "height_km = 514", "height_km = 200") +
            "[deputy]\nposition_m = [0, -300, 0]\nspacecraft = { drag_m2_kg = 8 }\n");
  const string other = in_one_line(hamjet({"check", "deputy.toml"}).err);
  EXPECT_EQ(other.find("the chief decays"), string::npos) << other;
  EXPECT_EQ(in_one_line(hamjet({"check", "good.toml"}).err).find("decays"), string::npos);
}

// Drag of half rho v^2 C_D A / m is some 1e-7 m/s^2 at 514 km.
TEST_F(BadDrag, AThrusterWeakerThanTheAirIsWarnedOf) {
  const auto said_of = [&](const string& acceleration) {
    write("thrust.toml", drag_scene +
                             "[transfer]\ncount = 2\nstart = { position_m = [0, -1000, 0] }\n"
                             "end = { position_m = [0, -100, 0] }\n[thruster]\n"
                             "acceleration_m_s2 = " +
                             acceleration + "\n");
    return in_one_line(hamjet({"check", "thrust.toml"}).err);
  };
  const string weak = said_of("1e-9");
  EXPECT_NE(weak.find("thruster: weaker than the air, got 1e-09 m/s^2"), string::npos) << weak;
  EXPECT_EQ(said_of("1e-5").find("weaker than the air"), string::npos);
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
