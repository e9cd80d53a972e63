#include <algorithm>
#include <cmath>
#include <sstream>

#include "command_test.hpp"

// Self-checks of every study, and the motion of a deputy without impulses.

namespace hamjet::test {
namespace {

class StudyChecks : public CommandTest {
 protected:
  /// At e = 0.2 down to 6892.9 km times 0.8, which is 863.816 km below the surface.
  static std::string low_scene(double eccentricity) {
    return "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
           "J2 = 1e-9\n[nominal]\na_km = 6892.9\ne = " +
           std::to_string(eccentricity) +
           "\ni_deg = 97\nraan_deg = 0\nargp_deg = 90\nta_deg = 180\n"
           "[jet]\norder = 2\nduration_orbits = 0.8\n"
           "[deputy]\nposition_m = [0, -1000, 0]\n[validity]\ncount = 2\nsamples = 10\n"
           "[transfer]\ncount = 3\n[transfer.end]\nposition_m = [0, -100, 0]\n";
  }
  void expect_failed(const std::string& command, const std::string& scene,
                     const std::string& words) {
    SCOPED_TRACE(command);
    const CommandResult result = hamjet({command, scene, "-o", "out/" + command});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_NE(in_one_line(result.out).find("CHECK FAILED: surface: " + words), std::string::npos)
        << result.out;
    const Json summary = read_json(directory_ / "out" / command / "summary.json");
    EXPECT_EQ(summary["exit_code"], 1);
    ASSERT_EQ(summary["failed_checks"].size(), 1U);
    EXPECT_EQ(summary["failed_checks"][0].get<std::string>().find("surface: " + words), 0U);
    const std::filesystem::path page = directory_ / "out" / command / "report.html";
    if (command == "assign") return;
    EXPECT_NE(content(page).find("Check failed: surface: "), std::string::npos);
  }
};

TEST_F(StudyChecks, AChiefBelowTheSurfaceFailsEveryStudy) {
  write("low.toml", low_scene(0.2));
  write("high.toml", low_scene(0.001));
  for (const char* const command : {"motion", "validity", "transfer"}) {
    expect_failed(command, "low.toml", "the chief passes 863.816 km below the surface");
    const CommandResult high = hamjet({command, "high.toml", "-o", "out/high"});
    EXPECT_EQ(high.exit_code, 0) << command << high.err;
    const Json checks = read_json(directory_ / "out/high/summary.json")["checks"];
    ASSERT_EQ(checks.size(), 2U);
    EXPECT_EQ(checks[0]["name"], "energy");
    EXPECT_EQ(checks[0]["state"], "passed");
    EXPECT_EQ(checks[1]["name"], "surface");
    EXPECT_EQ(checks[1]["state"], "passed");
  }
  // The scene may turn it off.
  for (const char* const command : {"motion", "validity", "transfer"}) {
    EXPECT_EQ(hamjet({command, "low.toml", "--set", "checks.surface=false", "-o", "off"}).exit_code,
              0)
        << command;
  }
}

// The orbit goes down to 7100 km times 0.8.
TEST_F(StudyChecks, SoDoAssignmentsUncertaintiesAndLongMotions) {
  const auto scene = [](const std::string& tables) {
    return "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = "
           "6378.1363\nJ2 = 1.0826e-3\n[nominal]\na_km = 7100\ne = 0.2\ni_deg = 50\nraan_deg = "
           "0\nargp_deg = 30\nta_deg = 180\n[jet]\norder = 2\nduration_orbits = 1\n" +
           tables;
  };
  write("assign.toml", scene("[transfer]\ntimes_orbits = 0.8\n[assignment]\n[[assignment.deputy]]\n"
                             "position_m = [0, -1000, 0]\n[[assignment.slot]]\n"
                             "position_m = [0, -100, 0]\n"));
  write("uncertainty.toml", scene("[uncertainty]\nposition_m = [1, 1, 1]\nsamples = 0\n"));
  write("poincare.toml", scene("[event]\nsurface = \"apsis\"\ndirection = \"falling\"\n"
                               "amplitudes_m = [10]\n"));
  write("bounded.toml", scene("[bounded]\nsizes_km = [1]\nrevolutions = 10\n"));
  for (const std::string command : {"assign", "uncertainty", "poincare", "bounded"}) {
    expect_failed(command, command + ".toml", "the chief passes ");
  }
}

TEST_F(StudyChecks, AnEvaluatedSceneIsCheckedToo) {
  write("low.toml", low_scene(0.2));
  const CommandResult result = hamjet({"eval", "low.toml", "--deputy", "low.toml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("a check failed: surface: the chief passes 863.816 km"),
            std::string::npos)
      << result.err;
}

// A transfer that falls below the surface is none that can be flown, even where the chief stays
// above.
TEST_F(StudyChecks, TransfersBelowTheSurfaceAreMarked) {
  write(
      "two.toml",
      "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
      "[nominal]\na_km = 6378.2\ne = 0\ni_deg = 50\nraan_deg = 0\nu_deg = 0\n"
      "[jet]\norder = 2\nduration_orbits = 0.5\n[transfer]\ntimes_orbits = [0.3, 0.45]\n"
      "[transfer.start]\nposition_m = [0, -1000, 0]\n[transfer.end]\nposition_m = [0, 1000, 0]\n");
  const CommandResult result = hamjet({"transfer", "two.toml", "-o", "out/two"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("2 pass below the surface"), std::string::npos) << result.err;
  const Table table = read_table(directory_ / "out/two/transfers.csv");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_LT(table.number(i, "lowest_km"), 6378.1363);
  }
}

// Rest at x above a circle drifts by 12 pi x a revolution (Clohessy and Wiltshire), and -2 n x
// along the track would hold the place: at 7000 km 1.0780e-3 rad/s, at 100 m 0.2156 m/s.
TEST_F(StudyChecks, DriftIsToldWithItsCure) {
  write("two.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
        "i_deg = 50\nraan_deg = 0\nu_deg = 0\n[jet]\norder = 2\nduration_orbits = 1\n"
        "[deputy]\nposition_m = [100, 0, 0]\n[transfer]\ntimes_orbits = [0.3]\n"
        "[transfer.start]\nposition_m = [0, -1000, 0]\n[transfer.end]\nposition_m = [100, 0, 0]\n");
  const std::string told = "it drifts 3.77 km a revolution backwards";
  for (const char* const command : {"check", "motion", "transfer"}) {
    const std::string out = in_one_line(hamjet({command, "two.toml"}).out);
    EXPECT_NE(out.find(told), std::string::npos) << command << out;
    EXPECT_NE(out.find("with velocity_m_s = [0, -0.215"), std::string::npos) << command << out;
  }
  const double drift = -12 * std::acos(-1.0) * 100;
  const auto expect_drift = [&](const Json& json) {
    EXPECT_NEAR(json["drift_m_per_revolution"].get<double>(), drift, 2e-4 * -drift);
    EXPECT_NEAR(json["velocity_without_drift_m_s"][1].get<double>(), -0.2156, 1e-4);
    EXPECT_EQ(json["relative_elements_m"].size(), 6U);
  };
  expect_drift(read_json(directory_ / "out/two-motion/summary.json")["start"]);
  expect_drift(read_json(directory_ / "out/two-transfer/summary.json")["best"]["after_arrival"]);
  expect_drift(Json::parse(hamjet({"check", "two.toml", "--json"}).out)["deputy"]);
  const Table table = read_table(directory_ / "out/two-transfer/transfers.csv");
  EXPECT_NEAR(table.number(0, "end_drift_m_per_revolution"), drift, 2e-4 * -drift);
  EXPECT_NE(content(directory_ / "out/two-motion/report.html").find("drifts 3.77 km"),
            std::string::npos);
}

// Of eight revolutions eight rows would have the deputy at one place of its ellipse of 1000 m.
TEST_F(StudyChecks, RowsOfAMotionAreAtSeveralPlacesOfItsRevolution) {
  write("ellipse.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
        "i_deg = 50\nraan_deg = 0\nu_deg = 0\n[jet]\norder = 1\nduration_orbits = 8\n"
        "[deputy]\na_dex_m = 1000\n");
  std::istringstream lines(hamjet({"motion", "ellipse.toml"}).out);
  double least = 0, greatest = -1000;
  for (std::string line; std::getline(lines, line);) {
    double time = 0, radial = 0;
    if (!(std::istringstream(line) >> time >> radial)) continue;
    least = std::min(least, radial);
    greatest = std::max(greatest, radial);
  }
  EXPECT_LT(least, -900);
  EXPECT_GT(greatest, 500);
}

// All parts of a study of formations work backwards in time.
TEST_F(StudyChecks, Backwards) {
  write("back.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0.001\n"
        "i_deg = 51.6\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[jet]\norder = 2\n"
        "duration_orbits = -1.3\n[deputy]\nposition_m = [0, -1000, 100]\n[validity]\ncount = 2\n"
        "samples = 10\n[transfer]\ncount = 4\nkeep_out_m = [10, 20, 10]\n[transfer.start]\n"
        "position_m = [0, -1000, 100]\n[transfer.end]\nposition_m = [0, 1000, 0]\n");
  for (const char* const command : {"motion", "transfer", "validity"}) {
    EXPECT_EQ(hamjet({command, "back.toml"}).exit_code, 0) << command;
  }
  const Json motion = read_json(directory_ / "out/back-motion/summary.json");
  EXPECT_LE(motion["nearest"]["time_s"].get<double>(), 0);
  EXPECT_LE(motion["nearest"]["separation_m"].get<double>(), std::hypot(1000, 100));
}

// The speed of the chief itself is no relative velocity.
TEST_F(StudyChecks, AFastDeputyIsALikelySlip) {
  write("fast.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
        "i_deg = 50\nraan_deg = 0\nu_deg = 0\n[jet]\norder = 1\nduration_orbits = 0.1\n"
        "[deputy]\nposition_m = [0, -1000, 0]\nvelocity_m_s = [0, 7500, 0]\n");
  const CommandResult fast = hamjet({"check", "fast.toml"});
  EXPECT_NE(in_one_line(fast.err).find("deputy.velocity_m_s: fast beside its chief, got 7500 m/s"),
            std::string::npos)
      << fast.err;
  EXPECT_EQ(hamjet({"check", "fast.toml", "--set", "deputy.velocity_m_s=[0,300,0]"}).err, "");
}

}  // namespace
}  // namespace hamjet::test
