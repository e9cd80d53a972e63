#include "../command_test.hpp"

// A jet in C_D A / m of a scene that names no variables, and a message in other units.

namespace hamjet::test {
namespace {

const std::string air =
    "system = { model = \"earth\", gravity_degree = 2, atmosphere = \"harris-priester\" }\n";
const std::string pair = air + R"(spacecraft = { mass_kg = 4, area_m2 = 0.03 }
nominal = { epoch_utc = "2026-03-01T06:00:00", height_km = 514, i_deg = 97.5, raan_deg = 30, u_deg = 0 }
deputy = { position_m = [0, -300, 0], spacecraft = { mass_kg = 4, area_m2 = 0.06 } }
jet = { order = 2, duration_s = 600 }
)";

using EvalParameters = CommandTest;

TEST_F(EvalParameters, TheSceneNeedNotNameTheJetsVariables) {
  write("pair.toml", pair);
  const std::vector<std::string> variables = {
      "--set", R"(jet.variables=["x","y","z","px","py","pz","drag_m2_kg"])"};
  succeed({"run", "pair.toml", variables[0], variables[1]});
  const std::string without = hamjet({"eval", "out/pair", "--deputy", "pair.toml"}).out;
  EXPECT_NE(without.find("inside"), std::string::npos) << without;
  EXPECT_EQ(without,
            hamjet({"eval", "out/pair", "--deputy", "pair.toml", variables[0], variables[1]}).out);
  expect_error({"eval", "out/pair", "--deputy", "pair.toml", "--set", "nominal.height_km=515"}, 3,
               {"nominal", "another orbit"});
}

TEST_F(EvalParameters, AMessageInOtherUnitsIsToldThem) {
  write("sat.opm",
        "CCSDS_OPM_VERS = 2.0\nCREATION_DATE = 2026-03-01T06:00:00\nORIGINATOR = X\n"
        "OBJECT_NAME = SAT\nOBJECT_ID = 2026-001A\nCENTER_NAME = EARTH\nREF_FRAME = GCRF\n"
        "TIME_SYSTEM = UTC\nEPOCH = 2026-03-01T06:00:00\nX = 6892 [km]\nY = 0 [km]\nZ = 0 [km]\n"
        "X_DOT = 0 [km/s]\nY_DOT = 1 [km/s]\nZ_DOT = 7.5 [km/s]\nMASS = 4000 [g]\n"
        "DRAG_AREA = 300 [cm**2]\n");
  write("units.toml",
        air + "nominal = { opm_file = \"sat.opm\" }\njet = { order = 1, duration_s = 600 }\n");
  expect_error({"check", "units.toml"}, 3,
               {"atmosphere", "sat.opm:16: MASS: wrong unit, got \"[g]\", must be [kg]",
                "sat.opm:17: DRAG_AREA: wrong unit, got \"[cm**2]\", must be [m**2]"});
}

}  // namespace
}  // namespace hamjet::test
