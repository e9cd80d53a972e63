#include "command_test.hpp"

// A numerical failure does not remove existing results.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

class KeptResults : public CommandTest {
 protected:
  /// On Kepler's circle the normal position after half a revolution is -z0 whatever the velocity,
  /// so that F1 does not exist there.
  static std::string pair(const std::string& table) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n" +
           changed(orbit_elements, "e = 0.1", "e = 0") +
           "[jet]\norder = 2\nduration_orbits = 0.9\n" + gauss8("tolerance = 1e-13") + table;
  }

  /// The command must succeed first, and then fail without replacing its results; without earlier
  /// results it must leave its partial ones.
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
    // A failed set of results is replaced by a failure as by a result.
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
  // The deputy falls into the centre within pi sqrt(1/8) units of time.
  const std::string fall =
      changed(quick_scene(),
              "a_km = 10000\ne = 0.1\ni_deg = 30\nraan_deg = 10\nargp_deg = 20\nta_deg = 30\n",
              "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 0, 0]\n");
  write("fall.toml", changed(fall, "duration_canonical = 1", "duration_canonical = 0.1"));
  const std::vector<std::string> good =
      with_overrides({"run", "fall.toml", "-o", "out"}, {"generating_function=null"});
  expect_kept(good, with_overrides(good, {"jet.duration_canonical=3"}));
}

TEST_F(KeptResults, OfBoundedFormations) {
  write("long.toml",
        "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
        "J2 = 1.0826e-3\n[nominal]\na_km = 7100\ne = 0.01\ni_deg = 50\nraan_deg = 0\n"
        "argp_deg = 30\nta_deg = 0\n[jet]\norder = 2\nduration_orbits = 1\n"
        "[bounded]\nsizes_km = [2]\nrevolutions = 10\n");
  const std::vector<std::string> good = {"bounded", "long.toml", "-o", "out"};
  // These coefficients alone take the deputy further than its size.
  expect_kept(good, with_overrides(good, {"bounded.cross_track=0.9", "bounded.along_track=0.9"}));
}

// A chief that is almost at rest falls into the centre within pi sqrt(1/8) units of time.
TEST_F(KeptResults, OfUncertainties) {
  write("fall.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
        "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 1e-6, 0]\n[jet]\norder = 2\n"
        "duration_canonical = 0.1\n[uncertainty]\nframe = \"inertial\"\n"
        "position_m = [1, 1, 1]\nsamples = 0\n");
  const std::vector<std::string> good = {"uncertainty", "fall.toml", "-o", "out"};
  EXPECT_EQ(hamjet(good).exit_code, 0);
  const std::string earlier = content(directory_ / "out/summary.json");
  const auto before = files();
  EXPECT_EQ(hamjet(with_overrides(good, {"jet.duration_canonical=3"})).exit_code, 4);
  EXPECT_EQ(content(directory_ / "out/summary.json"), earlier);
  EXPECT_EQ(files(), before);
}

// On Kepler's orbit F1 does not exist after a whole revolution, but the jet and F2 do: these are
// results, in place of the earlier ones.
TEST_F(KeptResults, GiveWayToWhatAFailureLeaves) {
  const std::vector<std::string> good =
      with_overrides({"run", "quick.toml", "-o", "out"},
                     {"integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]",
                      "generating_function.kinds=[\"F1\", \"F2\"]"});
  EXPECT_EQ(hamjet(with_overrides(good, {"jet={order=2, duration_orbits=0.3}"})).exit_code, 0);
  const CommandResult part = hamjet(with_overrides(good, {"jet={order=2, duration_orbits=1}"}));
  EXPECT_EQ(part.exit_code, 4);
  EXPECT_EQ(part.err.find("kept"), std::string::npos) << part.err;
  const Json summary = read_json(directory_ / "out/summary.json");
  EXPECT_EQ(summary["exit_code"], 4);
  EXPECT_TRUE(summary["runs"][0]["exactness"][0]["error"].is_string());
  EXPECT_TRUE(summary["runs"][0]["exactness"][1]["error"].is_null());
}

}  // namespace
}  // namespace hamjet::test
