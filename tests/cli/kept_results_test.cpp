#include "command_test.hpp"

// A numerical failure does not cost the results that are there.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

class KeptResults : public CommandTest {
 protected:
  /// On Kepler's circle the normal position after half a revolution is -z0 whatever the velocity,
  /// so that F1 does not exist there.
  static std::string pair(const std::string& table) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
           "i_deg = 0\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[jet]\norder = 2\n" +
           table;
  }

  /// The command must do well, then fail without replacing what it wrote; alone it must leave what
  /// it has.
  void expect_kept(const std::vector<std::string>& good, const std::vector<std::string>& bad) {
    EXPECT_EQ(hamjet(good).exit_code, 0);
    const std::string earlier = content(directory_ / "out/summary.json");
    const auto before = files();
    const CommandResult result = hamjet(bad);
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(in_one_line(result.err)
                  .find("note: the earlier results in out are kept, and these "
                        "are not written; -o names another directory"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(result.out.find("results: "), std::string::npos) << result.out;
    EXPECT_EQ(content(directory_ / "out/summary.json"), earlier);
    EXPECT_EQ(files(), before);
    fs::remove_all(directory_ / "out");
    const CommandResult alone = hamjet(bad);
    EXPECT_EQ(alone.exit_code, 4);
    EXPECT_EQ(alone.err.find("kept"), std::string::npos) << alone.err;
    EXPECT_EQ(read_json(directory_ / "out/summary.json")["exit_code"], 4);
    // What has failed itself gives way, to a failure as to a result.
    EXPECT_EQ(hamjet(bad).err.find("kept"), std::string::npos);
    EXPECT_EQ(hamjet(good).exit_code, 0);
    EXPECT_EQ(read_json(directory_ / "out/summary.json")["exit_code"], 0);
  }
};

TEST_F(KeptResults, OfTransfers) {
  write("pair.toml", pair("[transfer]\nframe = \"RTN\"\nkind = \"F1\"\ntimes_orbits = 0.3\n"
                          "[transfer.start]\nposition_m = [0, -1000, 200]\n"
                          "[transfer.end]\nposition_m = [0, 100, 0]\n"));
  const std::vector<std::string> good = {"transfer", "pair.toml", "-o", "out"};
  expect_kept(good, with_overrides(good, {"transfer.times_orbits=0.5"}));
}

TEST_F(KeptResults, OfAssignments) {
  write("pair.toml", pair("[transfer]\nframe = \"RTN\"\nkind = \"F1\"\ntimes_orbits = 0.3\n"
                          "[assignment]\n"
                          "[[assignment.deputy]]\nposition_m = [0, -1000, 200]\n"
                          "[[assignment.slot]]\nposition_m = [0, 100, 0]\n"));
  const std::vector<std::string> good = {"assign", "pair.toml", "-o", "out"};
  expect_kept(good, with_overrides(good, {"transfer.times_orbits=0.5"}));
}

TEST_F(KeptResults, OfRunsThatHaveNone) {
  // It falls into the centre within pi sqrt(1/8) units of time.
  write("fall.toml",
        changed(quick_scene(),
                "a_km = 10000\ne = 0.1\ni_deg = 30\nraan_deg = 10\nargp_deg = 20\nta_deg = 30\n",
                "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 0, 0]\n"));
  const std::vector<std::string> good =
      with_overrides({"run", "fall.toml", "-o", "out"},
                     {"generating_function=null", "jet.duration_canonical=0.1"});
  expect_kept(good, with_overrides(good, {"jet.duration_canonical=3"}));
}

}  // namespace
}  // namespace hamjet::test
