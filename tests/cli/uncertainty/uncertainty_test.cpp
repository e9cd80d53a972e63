#include <cmath>

#include "../command_test.hpp"

// The command `uncertainty`: how the covariance of a scene grows.

namespace hamjet::test {
namespace {

class UncertaintyCommand : public CommandTest {
 protected:
  static std::string scene(const std::string& tables) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
           "i_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[jet]\norder = 2\n"
           "duration_orbits = 3\n" +
           tables;
  }
};

const std::string kilometre_a_second =
    "[uncertainty]\nposition_m = [1000, 1000, 1000]\nvelocity_m_s = [1, 1, 1]\ncount = 3\n"
    "samples = 200\n";

TEST_F(UncertaintyCommand, SaysWhetherTheLinearCovarianceMisleads) {
  write("wide.toml", scene(kilometre_a_second));
  const std::string out = in_one_line(succeed({"uncertainty", "wide.toml"}).out);
  for (const char* const words :
       {"After 4.857 h the position of the chief has the standard deviations", "77.1 km along T",
        "By then the linear covariance of the chief misleads", "the standard deviation along",
        "frame RTN with inertial derivatives; order 2", "negentropy (cartesian, RTN)",
        "report: out/wide-uncertainty/report.html"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json summary = read_json(directory_ / "out/wide-uncertainty/summary.json");
  EXPECT_EQ(summary["study"], "uncertainty");
  ASSERT_EQ(summary["times"].size(), 3U);
  const Json& state = summary["times"][2]["states"][0];
  EXPECT_EQ(state["linear_misleads"], true);
  EXPECT_EQ(state["flown"]["samples"], 200);
  // After whole revolutions of a circle, Clohessy and Wiltshire: N and vN are as at the start, and
  // R too, for the drift is along T alone.
  const Json& linear = state["families"][0]["orders"][0]["standard_deviation"];
  EXPECT_NEAR(linear[0].get<double>() / 1000, 1, 1e-6);
  EXPECT_NEAR(linear[2].get<double>() / 1000, 1, 1e-6);
  EXPECT_NEAR(linear[5].get<double>(), 1, 1e-6);
  // T drifts by -3 (n x + vT) t, with vT the inertial difference: n t = 6 pi.
  const double n = std::sqrt(398600.4415 / std::pow(7000.0, 3));
  const double turned = 18 * std::acos(-1.0);
  const double transverse = std::hypot(1000, turned * 1000, turned / n);
  EXPECT_NEAR(linear[1].get<double>() / transverse, 1, 1e-6);
  const Table table = read_table(directory_ / "out/wide-uncertainty/moments.csv");
  // Three times, one state, two orders and the samples, six components.
  EXPECT_EQ(table.rows.size(), 3U * 3U * 6U);
}

// Three hundred kilometres along the tangent are 6.4 km above the circle: to first order that is
// nothing, and of the deputy's metre it is thousands. A kilometre along it is 7 cm above, which in
// three revolutions drift by 18 pi times as much, 4 m of a standard deviation of 60.
TEST_F(UncertaintyCommand, RefusesCoordinatesThatDoNotReachADeputy) {
  const auto said = [&](const std::string& place) {
    write("far.toml",
          scene("[deputy]\nposition_m = [0, " + place + ", 0]\n" +
                "[uncertainty]\nsamples = 0\ncoordinates = [\"spherical\", \"nodal\"]\n"
                "[uncertainty.deputy]\nposition_m = [1, 1, 1]\nvelocity_m_s = [0, 0, 0]\n"));
    return in_one_line(succeed({"uncertainty", "far.toml", "--set", "jet.order=1"}).out);
  };
  const std::string far = said("300000");
  for (const char* const coordinates : {"spherical", "nodal"}) {
    const std::string words = std::string("No moments in ") + coordinates +
                              " coordinates: the deputy starts 300 km from the chief, whose "
                              "polynomials of order 1 miss its mean by";
    EXPECT_NE(far.find(words), std::string::npos) << words << " is not in " << far;
  }
  EXPECT_EQ(said("1000").find("No moments in"), std::string::npos);
}

TEST_F(UncertaintyCommand, SaysThatASmallCovarianceHolds) {
  write("small.toml",
        scene("[uncertainty]\nposition_m = [0.1, 0.1, 0.1]\nvelocity_m_s = [1e-4, 1e-4, 1e-4]\n"
              "samples = 0\n"));
  const std::string out = in_one_line(succeed({"uncertainty", "small.toml"}).out);
  EXPECT_NE(out.find("the linear covariance of the chief holds"), std::string::npos) << out;
  EXPECT_NE(out.find("No samples were flown"), std::string::npos) << out;
  const Json summary = read_json(directory_ / "out/small-uncertainty/summary.json");
  EXPECT_TRUE(summary["times"][0]["states"][0]["flown"].is_null());
  EXPECT_EQ(summary["times"][0]["states"][0]["linear_misleads"], false);
}

// After three revolutions 100 m along R and 0.1 m/s have drifted some 8 km along T, whose bend of
// T^2/(2 r) = 4 m stays small beside what each component spreads by, but not beside the 1e-6 m that
// the start's T leaves to a combination of them.
TEST_F(UncertaintyCommand, TellsCombinationsFromComponentsOfANearlySingularCovariance) {
  write("line.toml", scene("[uncertainty]\nposition_m = [100, 1e-6, 100]\n"
                           "velocity_m_s = [0.1, 0.1, 0.1]\nsamples = 0\n"));
  const std::string out = in_one_line(succeed({"uncertainty", "line.toml"}).out);
  for (const char* const words : {"holds for each component alone",
                                  "but not for all together, of which one may be wrong by "
                                  "anything",
                                  "most where one linear standard deviation is"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json state =
      read_json(directory_ / "out/line-uncertainty/summary.json")["times"][0]["states"][0];
  EXPECT_EQ(state["linear_misleads"], false);
  EXPECT_EQ(state["linear_misleads_of_combinations"], true);
}

TEST_F(UncertaintyCommand, NeedsATableAndAGoodCovariance) {
  write("none.toml", scene(""));
  expect_error({"uncertainty", "none.toml"}, 3,
               {"none.toml: uncertainty: missing, must be a table [uncertainty]"});
  write("bad.toml", scene("[uncertainty]\nposition_m = [1, 1, -1]\n"));
  expect_error({"uncertainty", "bad.toml"}, 3,
               {"bad.toml:15:21: uncertainty.position_m.2: no standard deviation, got -1"});
}

}  // namespace
}  // namespace hamjet::test
