#include "command_test.hpp"
#include "support/reference_data.hpp"

// Collisions in `hamjet uncertainty`: table [uncertainty.collision].

namespace hamjet::test {
namespace {

class Collision : public CommandTest {
 protected:
  static std::string scene(const std::string& collision, const std::string& deputy_uncertainty) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
           "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n"
           "[deputy]\nposition_m = [0, 100, 0]\n"
           "[jet]\norder = 2\nduration_s = 3000\n"
           "[uncertainty]\nposition_m = [10, 10, 10]\nsamples = 0\n" +
           deputy_uncertainty + "[uncertainty.collision]\n" + collision;
  }
};

TEST_F(Collision, OfTheShippedSceneIsThePublishedOne) {
  const std::string path =
      std::string(HAMJET_SOURCE_DIR) + "/data/scenes/conjunction-geosynchronous.toml";
  const std::string out =
      in_one_line(succeed({"uncertainty", path, "--set", "uncertainty.samples=0", "--set",
                           "uncertainty.collision.samples=50000", "-o", "out"})
                      .out);
  for (const char* const words :
       {"collision nearer than 15 m", "weighted samples, as good as",
        "closest approach of the means", "as a short encounter 1.467e-01 (Foster, Alfano)",
        "does not hold"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json published = read_reference_file("alfano2009.json")[0]["probability"];
  const Json collision = read_json(directory_ / "out/summary.json")["collision"];
  EXPECT_LE(collision["interval"][0], published["monte_carlo_95_percent"][1]);
  EXPECT_GE(collision["interval"][1], published["monte_carlo_95_percent"][0]);
  EXPECT_NEAR(collision["approaches"][0]["short_encounter"]["alfano"].get<double>(),
              published["short_encounter_2d"].get<double>(), 1e-6);
  EXPECT_EQ(collision["approaches"][0]["flights"], 64);
  const Table table = read_table(directory_ / "out/collision.csv");
  EXPECT_EQ(table.header, "time_s,probability");
  EXPECT_EQ(table.rows.size(), 201U);
}

TEST_F(Collision, RefusesWhatIsNoWindowAndWhatIsCertain) {
  const std::string deputy = "[uncertainty.deputy]\nposition_m = [10, 10, 10]\n";
  write("window.toml", scene("radius_m = 5\nwindow_s = [100, 50]\n", deputy));
  expect_error({"uncertainty", "window.toml"}, 3, {"uncertainty.collision.window_s", "no window"});
  write("late.toml", scene("radius_m = 5\nwindow_s = [100, 5000]\n", deputy));
  expect_error({"uncertainty", "late.toml"}, 3, {"window_s", "beyond the scene's end", "3000"});
  write("radius.toml", scene("radius_m = 0\n", deputy));
  expect_error({"uncertainty", "radius.toml"}, 3, {"uncertainty.collision.radius_m"});
  write("event.toml", scene("radius_m = 5\nevent = \"near\"\n", deputy));
  expect_error({"uncertainty", "event.toml"}, 3, {"event", "nearer"});
  std::string certain = scene("radius_m = 5\n", "");
  certain.replace(certain.find("[10, 10, 10]"), 12, "[0, 0, 0]");
  write("certain.toml", certain);
  expect_error({"uncertainty", "certain.toml"}, 3, {"known exactly", "must have a covariance"});
}

// Two circular orbits in one plane, one against the other: they meet head-on after a quarter of a
// revolution at twice the orbital speed, where the integral over the disc is exact to the curvature
// within milliseconds.
TEST_F(Collision, OfAHeadOnEncounterIsThatOfThePlane) {
  write("head-on.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
        "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.546053286, 0]\n"
        "[deputy]\nposition_km = [-7000, 0, 0]\nvelocity_km_s = [0, 7.546053286, 0]\n"
        "[jet]\norder = 2\nduration_s = 1500\n"
        "[uncertainty]\nposition_m = [10, 10, 10]\nvelocity_m_s = [1e-3, 1e-3, 1e-3]\n"
        "samples = 2000\n[uncertainty.deputy]\nposition_m = [10, 10, 10]\n"
        "[uncertainty.collision]\nradius_m = 5\nwindow_s = [1400, 1500]\nsamples = 20001\n");
  const CommandResult outcome = succeed({"uncertainty", "head-on.toml"});
  EXPECT_EQ(outcome.err.find("far from its chief"), std::string::npos) << outcome.err;
  const Json summary = read_json(directory_ / "out/head-on-uncertainty/summary.json");
  const Json& collision = summary["collision"];
  EXPECT_EQ(collision["samples"], 20001);
  ASSERT_EQ(collision["approaches"].size(), 1U);
  const Json& approach = collision["approaches"][0];
  EXPECT_NEAR(approach["speed_m_s"].get<double>(), 2 * 7546.053286, 1e-2);
  EXPECT_EQ(approach["short_encounter"]["holds"], true);
  EXPECT_EQ(approach["short_encounter"]["cut_by_window"], false);
  const double plane = approach["short_encounter"]["alfano"];
  EXPECT_NEAR(collision["probability"].get<double>(), plane,
              4 * collision["standard_error"].get<double>() + 1e-3 * plane);
  // Moments of the deputy are by polynomials about its own trajectory, 14 000 km from the chief's.
  const Json& deputy = summary["times"][0]["states"][1];
  ASSERT_EQ(deputy["name"], "deputy");
  const Json& moments = deputy["families"][0]["orders"][1];
  for (std::size_t i = 0; i < 6; ++i) {
    for (const char* const key : {"mean", "standard_deviations"}) {
      // Five scatters are left by chance once in some 100 000 tries of twelve numbers.
      EXPECT_NEAR(moments[key][i].get<double>(), deputy["flown"][key][i].get<double>(),
                  5 * deputy["flown"]["scatter"][key][i].get<double>())
          << key << i;
    }
  }
}

TEST_F(Collision, NamesTheKeyOfWhatCannotBeSampled) {
  std::string flat = scene("radius_m = 5\nsampling = \"entries\"\n",
                           "[uncertainty.deputy]\nposition_m = [10, 10, 0]\n");
  flat.replace(flat.find("[10, 10, 10]"), 12, "[10, 10, 0]");
  write("flat.toml", flat);
  expect_error({"uncertainty", "flat.toml"}, 3,
               {"flat.toml: uncertainty.collision.sampling: not possible for this encounter",
                "\"plain\"", "certain in a direction"});
  write("thin.toml", scene("radius_m = 1e-6\n", "[uncertainty.deputy]\nposition_m = [1, 1, 1]\n"));
  expect_error({"uncertainty", "thin.toml"}, 6,
               {"uncertainty.collision.radius_m: too small beside the window, got 1e-06"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
}

}  // namespace
}  // namespace hamjet::test
