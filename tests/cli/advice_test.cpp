#include "command_test.hpp"

// The advice for a mistake says where the key belongs, and never suggests other physics.

namespace hamjet::test {
namespace {

class Advice : public CommandTest {
 protected:
  std::string said(const std::string& tables) const {
    write("slip.toml",
          "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
          "i_deg = 50\nraan_deg = 0\nu_deg = 0\n[jet]\norder = 2\nduration_orbits = 1\n" +
              tables);
    const CommandResult result = hamjet({"check", "slip.toml"});
    EXPECT_EQ(result.exit_code, 3) << result.out;
    return in_one_line(result.err);
  }
};

TEST_F(Advice, KeysInOtherUnitsAndTablesAreNamed) {
  EXPECT_NE(said("[bounded]\nsizes_m = [1000]\n").find("must be sizes_km, in km"),
            std::string::npos);
  EXPECT_NE(said("[chief]\na_km = 7000\n").find("must be [nominal]"), std::string::npos);
  EXPECT_NE(said("[deputy]\nposition_km = [0, 1, 0]\n")
                .find("a place relative to the chief is position_m"),
            std::string::npos);
  const CommandResult order = hamjet({"check", "slip.toml", "--set", "order=5"});
  EXPECT_NE(in_one_line(order.err).find("jet.order"), std::string::npos) << order.err;
}

TEST_F(Advice, HelpKnowsTablesAndKeys) {
  for (const char* const table : {"deputy", "[deputy]"}) {
    const std::string out = succeed({"help", table}).out;
    EXPECT_NE(out.find("## `[deputy]`"), std::string::npos) << out;
    EXPECT_NE(out.find("`position_m`"), std::string::npos) << out;
  }
  const std::string key = succeed({"help", "largest_impulse_m_s"}).out;
  EXPECT_NE(key.find("## `[transfer]`"), std::string::npos) << key;
  const CommandResult scene_first = hamjet({"slip.toml", "motion"});
  EXPECT_EQ(scene_first.exit_code, 2);
  EXPECT_NE(in_one_line(scene_first.err).find("hamjet motion slip.toml"), std::string::npos)
      << scene_first.err;
  const CommandResult scene_alone = hamjet({"slip.toml"});
  EXPECT_EQ(scene_alone.exit_code, 2);
  EXPECT_NE(in_one_line(scene_alone.err).find("hamjet run slip.toml"), std::string::npos)
      << scene_alone.err;
}

// A study that takes longer than the measurement says so; a study that ends within the measurement
// has a time.
TEST_F(Advice, CheckMeasuresTimes) {
  write("quick.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
        "i_deg = 50\nraan_deg = 0\nu_deg = 0\n[jet]\norder = 1\nduration_s = 60\n"
        "[deputy]\nposition_m = [0, 100, 0]\n");
  const std::string out = in_one_line(succeed({"check", "quick.toml", "--time"}).out);
  EXPECT_NE(out.find("time run "), std::string::npos) << out;
  EXPECT_NE(out.find(", motion "), std::string::npos) << out;
}

}  // namespace
}  // namespace hamjet::test
