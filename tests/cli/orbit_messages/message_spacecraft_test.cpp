#include <string>

#include "../command_test.hpp"
#include "hamjet/formats/orbit_message.hpp"

// What orbit messages say of the spacecraft itself: keywords, units and order of CCSDS 502.0-B-3,
// table 3-3.

namespace hamjet::test {
namespace {

using std::string;

const string cube_message = R"(CCSDS_OPM_VERS = 3.0
CREATION_DATE = 2026-03-01T00:00:00
ORIGINATOR = HAND
OBJECT_NAME = CUBE
OBJECT_ID = 2026-001A
CENTER_NAME = EARTH
REF_FRAME = GCRF
TIME_SYSTEM = UTC
EPOCH = 2026-03-01T06:00:00
X = 6892.137 [km]
Y = 0 [km]
Z = 0 [km]
X_DOT = 0 [km/s]
Y_DOT = -0.99 [km/s]
Z_DOT = 7.54 [km/s]
MASS = 4 [kg]
SOLAR_RAD_AREA = 0.04 [m**2]
SOLAR_RAD_COEFF = 1.2
DRAG_AREA = 0.03 [m**2]
DRAG_COEFF = 2.4
)";

const string cube_scene = R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
atmosphere = "harris-priester"
radiation = true
[nominal]
opm_file = "cube.opm"
[jet]
order = 1
duration_s = 600
[output]
formats = ["opm"]
)";

class MessageSpacecraft : public CommandTest {
 protected:
  Json summary_of(const string& text) {
    write("cube.toml", text);
    succeed({"run", "cube.toml", "-q", "-o", "out"});
    return read_json(directory_ / "out/summary.json");
  }
};

TEST_F(MessageSpacecraft, IsTheSpacecraftOfTheScene) {
  write("cube.opm", cube_message);
  const Json summary = summary_of(cube_scene);
  const Json& earth = summary["system"]["earth"];
  EXPECT_DOUBLE_EQ(earth["drag_m2_kg"], 2.4 * 0.03 / 4);
  EXPECT_DOUBLE_EQ(earth["radiation_m2_kg"], 1.2 * 0.04 / 4);
  EXPECT_TRUE(summary["nominal_file"]["unused"].empty());
  // The spacecraft is written back, and read again.
  const string text = content(directory_ / "out/gauss8/end.opm");
  const io::OpmSpacecraft back = io::read_opm("end.opm", text).spacecraft;
  EXPECT_EQ(back.mass_kg, 4);
  EXPECT_EQ(back.radiation_area_m2, 0.04);
  EXPECT_EQ(back.radiation_coefficient, 1.2);
  EXPECT_EQ(back.drag_area_m2, 0.03);
  EXPECT_EQ(back.drag_coefficient, 2.4);
  EXPECT_LT(text.find("Z_DOT"), text.find("MASS = 4.000000000000000e+00 [kg]"));
  EXPECT_LT(text.find("SOLAR_RAD_COEFF = 1.2"), text.find("DRAG_AREA = 2.999999999999999"));
}

TEST_F(MessageSpacecraft, ATableOfTheSceneGoesBeforeIt) {
  write("cube.opm", cube_message);
  const Json summary = summary_of(cube_scene + "[spacecraft]\nmass_kg = 5\narea_m2 = 0.1\n");
  EXPECT_DOUBLE_EQ(summary["system"]["earth"]["drag_m2_kg"], 2.2 * 0.1 / 5);
  EXPECT_EQ(summary["nominal_file"]["unused"], Json({"spacecraft parameters"}));
  EXPECT_EQ(*io::read_opm("a", content(directory_ / "out/gauss8/start.opm")).spacecraft.mass_kg, 5);
}

TEST_F(MessageSpacecraft, WithoutCoefficientsTheUsualOnes) {
  write("cube.opm", changed(changed(cube_message, "DRAG_COEFF = 2.4\n", ""),
                            "SOLAR_RAD_COEFF = 1.2", "SOLAR_RAD_COEFF = 0"));
  const Json earth = summary_of(cube_scene)["system"]["earth"];
  EXPECT_DOUBLE_EQ(earth["drag_m2_kg"], 2.2 * 0.03 / 4);
  EXPECT_EQ(earth["radiation_m2_kg"], 0);
}

TEST_F(MessageSpacecraft, OfADeputy) {
  write("cube.opm", cube_message);
  write("other.opm", changed(changed(cube_message, "Y = 0 [km]", "Y = 0.1 [km]"),
                             "DRAG_AREA = 0.03", "DRAG_AREA = 0.06"));
  write("pair.toml", changed(cube_scene, "[jet]", "[deputy]\nopm_file = \"other.opm\"\n[jet]"));
  succeed({"motion", "pair.toml", "-q", "-o", "with"});
  write("other.opm", changed(cube_message, "Y = 0 [km]", "Y = 0.1 [km]"));
  succeed({"motion", "pair.toml", "-q", "-o", "without"});
  const auto end_m = [&](const string& folder) {
    const Table table = read_table(directory_ / folder / "motion.csv");
    return table.number(table.rows.size() - 1, "T_m");
  };
  // f t^2 / 2 along the motion in so short a time, with the densities of 514 km.
  const double f = 0.5 * 2.4 * 0.03 / 4 * 7600.0 * 7600.0;
  const double ahead = std::abs(end_m("with") - end_m("without"));
  EXPECT_GT(ahead, 0.5 * f * 2.5e-13 * 600 * 600 * 0.9);
  EXPECT_LT(ahead, 0.5 * f * 1.8e-12 * 600 * 600 * 1.1);
}

TEST_F(MessageSpacecraft, MistakesAreOneLine) {
  write("cube.toml", cube_scene);
  write("cube.opm", changed(cube_message, "MASS = 4 [kg]\n", ""));
  expect_error({"check", "cube.toml"}, 3, {"cube.toml:5", "atmosphere", "MASS and DRAG_AREA"});
  write("cube.opm", changed(cube_message, "SOLAR_RAD_AREA = 0.04 [m**2]\n", ""));
  expect_error({"check", "cube.toml"}, 3, {"cube.toml:6", "radiation", "SOLAR_RAD_AREA"});
  write("cube.opm", changed(cube_message, "MASS = 4", "MASS = -4"));
  expect_error({"check", "cube.toml"}, 3, {"cube.toml:8", "opm_file", "a mass of -4 kg"});
  write("cube.opm", changed(cube_message, "DRAG_AREA = 0.03", "DRAG_AREA = 300"));
  const string said = in_one_line(hamjet({"check", "cube.toml"}).err);
  EXPECT_NE(said.find("is the area in cm^2"), string::npos) << said;
}

}  // namespace
}  // namespace hamjet::test
