#include "command_test.hpp"

// The command `motion`: where the deputy of a scene goes by itself.

namespace hamjet::test {
namespace {

class Motion : public CommandTest {
 protected:
  static std::string scene(const std::string& deputy) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
           "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n"
           "[jet]\norder = 2\nduration_orbits = 1\n" +
           deputy;
  }
};

TEST_F(Motion, SaysHowNearHowFarAndHowWrong) {
  write("two.toml", scene("[deputy]\nposition_km = [7000, 1, 0]\nvelocity_km_s = [0, 7.5, 1]\n"));
  const std::string out = in_one_line(succeed({"motion", "two.toml"}).out);
  for (const char* const words :
       {"the deputy is nearest to its chief after ", "Polynomials of order 2 are never wrong by",
        "the linear theory by up to ", "frame RTN with rotating derivatives; order 2",
        "time (min) R (m) T (m) N (m) separation error linear error",
        "report: out/two-motion/report.html"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json summary = read_json(directory_ / "out/two-motion/summary.json");
  EXPECT_EQ(summary["study"], "motion");
  EXPECT_EQ(summary["is_resolved"], true);
  // 1 km along y, where T is the direction of (0, 7.5, 1).
  EXPECT_NEAR(summary["start"]["separation_m"].get<double>(), 1000, 1e-9);
  EXPECT_NEAR(summary["start"]["position_m"][1].get<double>(), 7500 / std::hypot(7.5, 1), 1e-9);
  ASSERT_EQ(summary["largest_error_m_by_order"].size(), 2U);
  const Table table = read_table(directory_ / "out/two-motion/motion.csv");
  EXPECT_EQ(table.header,
            "time_canonical,time_s,R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s,separation_m,"
            "error_m_order_1,error_m_order_2");
  EXPECT_EQ(table.rows.size(), summary["times"].get<std::size_t>());
  double largest = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    largest = std::max(largest, table.number(i, "error_m_order_2"));
  }
  EXPECT_DOUBLE_EQ(largest, summary["largest_error_m_by_order"][1].get<double>());
}

TEST_F(Motion, SaysWhereTheOrderDoesNotReach) {
  write("far.toml", scene("[deputy]\nposition_m = [0, 300000, 0]\n"));
  const std::string out = in_one_line(succeed({"motion", "far.toml", "--set", "jet.order=1"}).out);
  EXPECT_NE(out.find("the deputy is beyond what order 1 resolves"), std::string::npos) << out;
  EXPECT_EQ(read_json(directory_ / "out/far-motion/summary.json")["is_resolved"], false);
}

TEST_F(Motion, NeedsADeputyAndATime) {
  write("none.toml", scene(""));
  expect_error({"motion", "none.toml"}, 3,
               {"none.toml: deputy: missing, must be a table [deputy]; the smallest is deputy = "
                "{position_m = [0, -1000, 0]}"});
  write("still.toml", scene("[deputy]\nposition_m = [0, 1, 0]\n"));
  expect_error({"motion", "still.toml", "--set", "jet.duration_orbits=0"}, 3,
               {"deputy: no motion in no time"});
}

}  // namespace
}  // namespace hamjet::test
