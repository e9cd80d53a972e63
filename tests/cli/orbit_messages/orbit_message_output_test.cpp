#include <cmath>

#include "orbit_message_test.hpp"

// Orbit messages that are written.

namespace hamjet::test {
namespace {

/// A fraction as Python prints it.
double fraction(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double numerator = std::stod(text.substr(0, slash));
  return slash == std::string::npos ? numerator : numerator / std::stod(text.substr(slash + 1));
}

bool has_python() { return std::filesystem::exists(python); }

TEST_F(OrbitMessages, TheNominalIsWrittenAsItStandsInTheCsv) {
  if (!has_python()) GTEST_SKIP() << "no " << python;
  succeed({"run", "dated.toml", "-q"});
  const Json summary = read_json(directory_ / "out/dated/summary.json");
  const double length = summary["units"]["length_km"];
  const double speed = length / summary["units"]["time_s"].get<double>();
  for (const std::string label : {"gauss8", "midpoint"}) {
    const Table states = checked("out/dated/" + label + "/nominal.oem");
    const Table nominal = read_table(directory_ / ("out/dated/" + label + "/nominal.csv"));
    ASSERT_EQ(states.rows.size(), nominal.rows.size());
    ASSERT_GT(states.rows.size(), 2U);
    for (std::size_t i = 0; i < states.rows.size(); ++i) {
      EXPECT_EQ(states.rows[i][0], "CHIEF");
      EXPECT_NEAR(fraction(states.rows[i][1]), std::stod(nominal.rows[i][1]), 2e-12);
      for (std::size_t k = 0; k < 6; ++k) {
        const double expected = std::stod(nominal.rows[i][2 + k]) * (k < 3 ? length : speed);
        EXPECT_NEAR(std::stod(states.rows[i][2 + k]), expected, 1e-15 * std::abs(expected));
      }
    }
  }
  const std::string text = content(directory_ / "out/dated/gauss8/nominal.oem");
  EXPECT_EQ(text.rfind("CCSDS_OEM_VERS = 2.0\n", 0), 0U);
  EXPECT_NE(text.find("\nTIME_SYSTEM = TAI\nSTART_TIME = 2026-02-28T23:59:50.500000000000\n"),
            std::string::npos);
  EXPECT_NE(text.find("\n2026-03-01T00:"), std::string::npos);
  EXPECT_NE(text.find("Accuracy: not measured"), std::string::npos);
}

TEST_F(OrbitMessages, BackwardsInTimeTheStatesAreInOrder) {
  if (!has_python()) GTEST_SKIP() << "no " << python;
  succeed({"run", "dated.toml", "-q", "--set", "jet.duration_canonical=-1", "--set",
           "ephemeris.oem_version=3.0"});
  EXPECT_GT(checked("out/dated/gauss8/nominal.oem").rows.size(), 2U);
  const std::string text = content(directory_ / "out/dated/gauss8/nominal.oem");
  EXPECT_EQ(text.rfind("CCSDS_OEM_VERS = 3.0\n", 0), 0U);
  EXPECT_NE(text.find("STOP_TIME = 2026-02-28T23:59:50.500000000000\n"), std::string::npos);
}

TEST_F(OrbitMessages, ARunGoesOnFromWhereAnotherEnded) {
  succeed({"run", "dated.toml", "-q"});
  const Json first = read_json(directory_ / "out/dated/summary.json");
  const std::string message = content(directory_ / "out/dated/gauss8/nominal.oem");
  const std::size_t stop = message.find("\nSTOP_TIME = ") + 13;
  const std::string epoch = message.substr(stop, message.find('\n', stop) - stop);
  std::string scene = content(directory_ / "dated.toml");
  const std::size_t begin = scene.find("a_km"), end = scene.find("[jet]");
  scene.replace(begin, end - begin,
                "oem_file = \"out/dated/gauss8/nominal.oem\"\nepoch = \"" + epoch + "\"\n");
  scene = scene.substr(0, scene.find("[ephemeris]"));
  scene = changed(
      scene, "duration_canonical = 1",
      "duration_canonical = -1\n[units]\nlength_km = " + first["units"]["length_km"].dump());
  write("back.toml", scene);
  succeed({"run", "back.toml", "-q"});
  const Json second = read_json(directory_ / "out/back/summary.json");
  EXPECT_EQ(second["nominal_file"]["format"], "OEM 2.0");
  EXPECT_EQ(second["nominal_file"]["path"], "out/dated/gauss8/nominal.oem");
  EXPECT_EQ(second["ephemeris"]["epoch"], epoch);
  EXPECT_EQ(second["ephemeris"]["time_system"], "TAI");
  EXPECT_EQ(second["ephemeris"]["object_name"], "CHIEF");
  for (std::size_t i = 0; i < 6; ++i) {
    // The state goes out and back; the message has 16 digits.
    const double x = first["runs"][0]["nominal_final"][i];
    EXPECT_NEAR(second["nominal_initial"][i].get<double>(), x, 1e-15 * (1 + std::abs(x)));
    EXPECT_NEAR(second["runs"][0]["nominal_final"][i].get<double>(),
                first["nominal_initial"][i].get<double>(), 1e-12);
  }
}

TEST_F(OrbitMessages, ChiefAndDeputyOfATransfer) {
  if (!has_python()) GTEST_SKIP() << "no " << python;
  const std::string shipped = std::string(HAMJET_SOURCE_DIR) + "/data/scenes/orbit-messages.toml";
  succeed({"transfer", shipped, "-q", "-o", "out", "--set", "transfer.count=3"});
  const Table chief = checked("out/chief.oem");
  const Table deputy = checked("out/deputy.oem");
  ASSERT_EQ(chief.rows.size(), deputy.rows.size());
  EXPECT_EQ(chief.rows[0][0], "EUTELSAT W4");
  EXPECT_EQ(deputy.rows[0][0], "INSPECTOR");
  const auto distance_m = [&](std::size_t row) {
    double sum = 0;
    for (std::size_t k = 2; k < 5; ++k) {
      sum += std::pow(std::stod(deputy.rows[row][k]) - std::stod(chief.rows[row][k]), 2);
    }
    return 1000 * std::sqrt(sum);
  };
  // The ends that the scene asks for; 16 digits of 42 000 km are some 1e-8 m.
  EXPECT_NEAR(distance_m(0), 20000, 1e-6);
  EXPECT_NEAR(distance_m(chief.rows.size() - 1), 500, 1e-2);
  const Json summary = read_json(directory_ / "out/summary.json");
  EXPECT_NEAR(fraction(chief.rows.back()[1]), summary["best"]["time_s"], 1e-9);
  EXPECT_EQ(summary["nominal_file"]["path"], "eutelsat-w4.opm");
}

TEST_F(OrbitMessages, TheTablesOutputAndEphemeris) {
  const auto refuse = [&](const std::string& from, const std::string& to,
                          const std::vector<std::string>& words) {
    write("bad.toml", quick_scene() + changed(dated, from, to));
    expect_error({"check", "bad.toml"}, 3, words);
  };
  refuse("\"oem\"", "\"oen\"",
         {"output.formats.0: unknown format, got \"oen\", did you mean oem?"});
  refuse("\"oem\"", "3", {"output.formats.0: wrong type"});
  refuse("formats", "format", {"output.format: unknown key", "did you mean formats?"});
  refuse("2026-02-28", "2026-02-29", {"ephemeris.epoch: no moment of the calendar"});
  refuse("TAI", "UT1", {"ephemeris.time_system: unknown value", "UTC, TAI, TT, GPS, TDB"});
  refuse("TOD", "ITRF2000", {"ephemeris.reference_frame: a frame that rotates"});
  refuse("CHIEF", "CHIEF\\n", {"ephemeris.object_name: no text of an orbit message"});
  refuse("center_name = \"EARTH\"\n", "", {"ephemeris.center_name: missing"});
  refuse("center_name = \"EARTH\"", "center_name = \"Moon\"",
         {"ephemeris.center_name: another centre than the scene's, got \"Moon\" and "
          "system.mu_km3_s2 = 398600.4",
          "or mu near 4902.8"});
  write("unknown.toml", quick_scene() + changed(dated, "\"EARTH\"", "\"TERRA\""));
  const CommandResult unknown = hamjet({"check", "unknown.toml"});
  EXPECT_EQ(unknown.exit_code, 0);
  EXPECT_NE(unwrapped(unknown.err).find("ephemeris.center_name: \"TERRA\" is none of the Sun"),
            std::string::npos)
      << unknown.err;
  refuse("[ephemeris]", "[ephemeris]\noem_version = 1.0",
         {"ephemeris.oem_version: unknown version"});
  refuse("2026-02-28T23:59:50.5\"\ntime_system = \"TAI\"",
         "2016-12-31T23:59:50.5\"\ntime_system = \"UTC\"",
         {"ephemeris.epoch: a span across the leap second at the end of 2016-12-31"});
  refuse("2026-02-28T23:59:50.5\"\ntime_system = \"TAI\"",
         "2016-12-31T23:59:60.5\"\ntime_system = \"UTC\"",
         {"ephemeris.epoch: within a leap second"});
  refuse("2026-02-28T23:59:50.5\"\ntime_system = \"TAI\"",
         "1971-12-31T23:59:50.5\"\ntime_system = \"UTC\"", {"ephemeris.epoch: before 1972"});
  refuse("2026-02-28", "9999-12-31", {"ephemeris.epoch: a span that leaves the calendar"});
  write("bad.toml", quick_scene() + "[output]\nformats = [\"oem\"]\n");
  expect_error({"check", "bad.toml"}, 3, {"output.formats: \"oem\" without a date"});
  // Across a leap second in a system that has none.
  write("good.toml", quick_scene() + changed(dated, "2026-02-28", "2016-12-31"));
  succeed({"check", "good.toml"});
  write("bad.toml",
        from_message("oem_file = \"low.oem\"\n") + "[ephemeris]\nreference_frame = \"TOD\"\n");
  expect_error({"check", "bad.toml"}, 3,
               {"ephemeris.reference_frame: not that of the nominal's file, got \"TOD\", must be "
                "\"ICRF\" or left out"});
}

}  // namespace
}  // namespace hamjet::test
