#include <cmath>

#include "command_test.hpp"

// A gravity field from a file: what the results say of it, and what is said of a damaged one.

namespace hamjet::test {
namespace {

class GravityFile : public CommandTest {
 protected:
  GravityFile() {
    const std::filesystem::path shipped = HAMJET_SOURCE_DIR;
    std::filesystem::create_directory(directory_ / "scenes");
    write("field.gfc", content(shipped / "data/gravity/EGM96-zonals.gfc"));
    write("scenes/scene.toml",
          changed(quick_scene(), "model = \"kepler\"\nmu_km3_s2 = 398600.4415",
                  "model = \"zonal-gravity\"\ngravity_file = \"../field.gfc\"\nhighest_zonal = 6"));
  }
};

TEST_F(GravityFile, IsNamedInTheSummaryWithAllThatWasTakenFromIt) {
  succeed({"run", "scenes/scene.toml", "-q", "-o", "file"});
  const Json system = read_json(directory_ / "file/summary.json")["system"];
  EXPECT_EQ(system["mu_km3_s2"], 398600.4415);
  EXPECT_EQ(system["radius_km"], 6378.1363);
  EXPECT_EQ(system["zonal_coefficients"].size(), 5U);
  EXPECT_EQ(system["zonal_coefficients"]["J4"], -1.619621591367e-6);
  EXPECT_EQ(system["gravity_file"]["file"], "../field.gfc");
  EXPECT_EQ(system["gravity_file"]["model_name"], "EGM96");
  EXPECT_EQ(system["gravity_file"]["tide_system"], "tide_free");
  // The same numbers key by key give the same results.
  const Json& J = system["zonal_coefficients"];
  std::string table = "system={model=\"zonal-gravity\", mu_km3_s2=398600.4415, radius_km=6378.1363";
  for (const auto& [key, value] : J.items()) table += ", " + key + "=" + value.dump();
  succeed({"run", "scenes/scene.toml", "-q", "-o", "keys", "--set", table + "}"});
  const Json other = read_json(directory_ / "keys/summary.json");
  EXPECT_EQ(other["system"]["zonal_coefficients"], J);
  EXPECT_TRUE(other["system"]["gravity_file"].is_null());
  EXPECT_EQ(content(directory_ / "keys/gauss8/jet.csv"),
            content(directory_ / "file/gauss8/jet.csv"));
  // Without an orbit there is no field.
  succeed({"run", "scenes/scene.toml", "-q", "-o", "kepler", "--set",
           "system={model=\"kepler\", mu_km3_s2=1}"});
  EXPECT_TRUE(read_json(directory_ / "kepler/summary.json")["system"]["radius_km"].is_null());
}

// J5 doubles within a Julian year because its trend equals its value.
TEST_F(GravityFile, ThatVariesWithTimeIsTakenAtTheEpoch) {
  const std::string field = content(directory_ / "field.gfc");
  const std::string row = "gfc     5    0   0.685323475630e-07   0.0 0 0";
  const std::size_t line = field.find("gfc     5    0");
  const std::size_t end = field.find('\n', line);
  write("field.gfc", field.substr(0, line) + "gfct" + row.substr(3) + " 20200101\n" + "trnd" +
                         row.substr(3) + "\ngfc 1 0 1e-9 0" + field.substr(end));
  const double J5 = -std::sqrt(11.0) * 0.685323475630e-7;
  const std::vector<std::string> overrides = {"system.gravity_epoch=\"2020-12-31T06:00:00\"",
                                              "system.leave_out_C10=true"};
  succeed(with_overrides({"run", "scenes/scene.toml", "-q", "-o", "out"}, overrides));
  const Json system = read_json(directory_ / "out/summary.json")["system"];
  EXPECT_NEAR(system["zonal_coefficients"]["J5"].get<double>() / (2 * J5), 1, 1e-15);
  EXPECT_EQ(system["gravity_file"]["epoch"], "2020-12-31T06:00:00.000000000000");
  EXPECT_NEAR(system["gravity_file"]["origin_offset_m"].get<double>(),
              std::sqrt(3.0) * 6378136.3e-9, 1e-15);
  const std::string check =
      in_one_line(succeed(with_overrides({"check", "scenes/scene.toml"}, overrides)).out);
  for (const char* words : {"field EGM96 (tide_free) from ../field.gfc: J2 J3 J4 J5 J6",
                            "coefficients that vary with time are taken at 2020-12-31T06:00:00",
                            "the centre of mass at z = 0.01105 m"}) {
    EXPECT_NE(check.find(words), std::string::npos) << check;
  }
  expect_error(
      {"run", "scenes/scene.toml"}, 5,
      {"scenes/../field.gfc:23: gfct: C(5,0) varies with time", "gravity_epoch in [system]"});
}

TEST_F(GravityFile, DamagedItIsOneLineAndExitCode5) {
  const std::string field = content(directory_ / "field.gfc");
  const auto refuse = [&](const std::string& damaged, const std::string& words) {
    write("field.gfc", damaged);
    for (const char* command : {"run", "check"}) {
      expect_error({command, "scenes/scene.toml"}, 5, {"scenes/../field.gfc:", words});
    }
  };
  refuse(changed(field, "end_of_head", "end"), ":38: the header has no end_of_head");
  refuse(changed(field, "0.539873863789e-06", "0.53987386378ge-06"),
         ":22: C(4,0): must be a finite");
  refuse(changed(field, "gfc     5    0", "trnd    5    0"), ":23: trnd: C(5,0) varies with time");
  refuse(field.substr(0, field.find("gfc     6")), ":23: the file ends without C(6,0)");
  refuse("", ":1: the header has no end_of_head");
  std::filesystem::remove(directory_ / "field.gfc");
  expect_error(
      {"run", "scenes/scene.toml"}, 5,
      {"scene.toml:5:16: system.gravity_file: scenes/../field.gfc cannot be read: No such"});
}

}  // namespace
}  // namespace hamjet::test
