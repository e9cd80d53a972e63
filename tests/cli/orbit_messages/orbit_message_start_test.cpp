#include <cmath>

#include "orbit_message_test.hpp"

// Scenes that start from orbit messages.

namespace hamjet::test {
namespace {

/// The standard's parameters without its elements, which are not those of its state and warned of.
std::string state_alone() {
  std::string text = io::standard_opm;
  const std::size_t first = text.find("SEMI_MAJOR_AXIS");
  return text.erase(first, text.find("GM  ") - first);
}

TEST_F(OrbitMessages, TheOrbitOfAnotherProgramIsFollowed) {
  // The difference of the force models, some 1e-5 m/s^2, amounts to less than a metre in a minute.
  write("low.toml", from_message("oem_file = \"low.oem\"\nepoch = \"2020-153T12:01:00Z\"\n"));
  succeed({"run", "low.toml", "-q"});
  const Json summary = read_json(directory_ / "out/low/summary.json");
  const double length = summary["units"]["length_km"];
  const double speed = length / summary["units"]["time_s"].get<double>();
  const double expected[] = {-4.590937743703589e+03, -3.666030848199918e+03,
                             3.411273695970938e+03,  1.317718313079672e+00,
                             -5.967490649721602e+00, -4.622251514385893e+00};
  for (std::size_t i = 0; i < 6; ++i) {
    const double flown = summary["runs"][0]["nominal_final"][i];
    EXPECT_NEAR(flown * (i < 3 ? length : speed), expected[i], i < 3 ? 1e-3 : 2e-5);
  }
  EXPECT_EQ(summary["ephemeris"]["reference_frame"], "ICRF");
  EXPECT_EQ(summary["ephemeris"]["center_name"], "Earth");
  EXPECT_EQ(summary["ephemeris"]["epoch"], "2020-06-01T12:01:00.000000000000");
}

TEST_F(OrbitMessages, AFrameOfEpochKeepsItsEpoch) {
  std::string message = changed(low_orbit, "REF_FRAME            = ICRF",
                                "REF_FRAME            = TEMEOFEPOCH\n"
                                "REF_FRAME_EPOCH      = 2000-01-01T00:00:00");
  message = changed(message, "-4.059846290755485e+00", "-4.059846290755485e+00 0 0 0");
  write("low.oem", message);
  write("low.toml",
        from_message("oem_file = \"low.oem\"\n") + "[output]\nformats = [\"oem\", \"dace\"]\n");
  succeed({"run", "low.toml", "-q"});
  const std::string epoch = "2000-01-01T00:00:00.000000000000";
  EXPECT_NE(content(directory_ / "out/low/gauss8/nominal.oem").find("REF_FRAME_EPOCH = " + epoch),
            std::string::npos);
  EXPECT_NE(content(directory_ / "out/low/gauss8/jet.dace").find("TEMEOFEPOCH of " + epoch),
            std::string::npos);
  const Json summary = read_json(directory_ / "out/low/summary.json");
  EXPECT_EQ(summary["ephemeris"]["reference_frame_epoch"], epoch);
  EXPECT_EQ(summary["nominal_file"]["unused"], Json({"accelerations"}));
  write("dated.toml", quick_scene() + changed(dated, "\"TOD\"", "\"TEMEOFEPOCH\""));
  expect_error({"check", "dated.toml"}, 3, {"ephemeris.reference_frame_epoch: missing"});
}

TEST_F(OrbitMessages, TheStandardsParametersAreAStart) {
  write("w4.toml", from_message("opm_file = \"standard.opm\"\n"));
  // The elements of the message are not those of its state.
  const CommandResult result = hamjet({"run", "w4.toml", "-q", "-o", "elsewhere"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(unwrapped(result.err)
                .rfind("hamjet: warning: w4.toml:9:12: nominal.opm_file: Keplerian "
                       "elements that are not those of the state",
                       0),
            0U)
      << result.err;
  const Json summary = read_json(directory_ / "elsewhere/summary.json");
  EXPECT_NEAR(summary["units"]["length_km"],
              std::sqrt(6655.9942 * 6655.9942 + 40218.5751 * 40218.5751 + 82.9177 * 82.9177), 1e-9);
  EXPECT_EQ(summary["nominal_file"]["format"], "OPM 3.0");
  EXPECT_EQ(summary["nominal_file"]["unused"],
            Json({"Keplerian elements", "spacecraft parameters"}));
  EXPECT_EQ(summary["ephemeris"]["object_name"], "EUTELSAT W4");
}

TEST_F(OrbitMessages, ADamagedFileIsOneLineAndExitCode5) {
  write("oem.toml", from_message("oem_file = \"bad.oem\"\n"));
  write("bad.oem", changed(low_orbit, "6.077667602389965e-01", "NaN"));
  expect_error({"run", "oem.toml"}, 5, {"bad.oem:22: no number, got \"NaN\", must be a finite"});
  write("bad.oem", std::string(low_orbit, std::string(low_orbit).find("USEABLE")));
  expect_error({"run", "oem.toml"}, 5, {"bad.oem:", "META_STOP: missing", "the end of the file"});
  write("opm.toml", from_message("opm_file = \"bad.opm\"\n"));
  write("bad.opm", changed(io::standard_opm, "[km/s]", "[m/s]"));
  expect_error({"run", "opm.toml"}, 5,
               {"bad.opm:20: X_DOT: wrong unit, got \"[m/s]\", must be [km/s]"});
  write("bad.opm", io::standard_rotating_opm);
  expect_error({"check", "opm.toml"}, 5, {"bad.opm:8: REF_FRAME: a frame that rotates"});
}

TEST_F(OrbitMessages, AFileThatCannotBeReadIsSaidWithTheSceneKey) {
  write("oem.toml", from_message("oem_file = \"none.oem\"\n"));
  expect_error({"run", "oem.toml"}, 5,
               {"oem.toml:9:12: nominal.oem_file: none.oem cannot be read: No such file"});
  expect_error({"run", "oem.toml", "--set", "nominal.oem_file=."}, 5,
               {"--set nominal.oem_file: ", "cannot be read: it is a directory"});
  std::filesystem::resize_file(write("none.oem", ""), (std::uintmax_t{64} << 20) + 1);
  expect_error({"run", "oem.toml"}, 6, {"none.oem cannot be read: it is too large, got 67108865"});
}

// Version 1.0 is that of 2004, which GMAT writes.
TEST_F(OrbitMessages, AnEphemerisOfVersion1) {
  write("one.oem", changed(low_orbit, "CCSDS_OEM_VERS = 2.0", "CCSDS_OEM_VERS = 1.0"));
  write("one.toml", from_message("oem_file = \"one.oem\"\n"));
  succeed({"run", "one.toml", "-q", "-o", "one"});
  const Json file = read_json(directory_ / "one/summary.json")["nominal_file"];
  EXPECT_EQ(file["format"], "OEM 1.0");
}

TEST_F(OrbitMessages, AnotherCentreThanTheScenesIsRefused) {
  const std::string opm = "opm_file = \"other.opm\"\n";
  const auto refuse = [&](const std::string& scene, const std::vector<std::string>& words) {
    write("other.toml", scene);
    expect_error({"check", "other.toml"}, 3, words);
  };
  const std::string mars =
      changed(state_alone(), "CENTER_NAME        =   EARTH", "CENTER_NAME        =   MARS");
  write("other.opm", changed(mars, "GM                = 398600.4415", "GM = 42828"));
  refuse(from_message(opm),
         {"other.toml:9:12: nominal.opm_file: another mu than the scene's, got GM = 42828 in "
          "other.opm:25 and system.mu_km3_s2 = 398600.4415, must agree to 1e-05"});
  write("other.opm", mars);
  refuse(from_message(opm),
         {"other.toml:9:12: nominal.opm_file: another centre than the scene's, got CENTER_NAME = "
          "MARS in other.opm:11 and system.mu_km3_s2 = 398600.4415 of EARTH, must be a message "
          "about EARTH, or a mu near 42828.376"});
  // The zonal field's axis would be taken along the Earth's.
  write("other.opm", changed(mars, "GM                = 398600.4415", "GM = 42828.3"));
  const std::string with_its_mu = changed(from_message(opm), "398600.4415", "42828.3");
  refuse(with_its_mu, {"zonal coefficients along the Earth's axis", "CENTER_NAME = MARS", "TOD",
                       "with z along the axis of MARS"});
  write("kepler.toml",
        changed(changed(with_its_mu, "radius_km = 6378.1363\nJ2 = 1.08262668355315e-3\n", ""),
                "zonal-gravity", "kepler"));
  succeed({"check", "kepler.toml"});
  // A centre that is not known is not the Earth, unless the scene says so itself.
  write("other.opm", changed(state_alone(), "CENTER_NAME        =   EARTH",
                             "CENTER_NAME        =   EARTH BARYCENTER"));
  refuse(from_message(opm), {"an unknown centre, got CENTER_NAME = EARTH BARYCENTER",
                             "must be EARTH, or ephemeris.center_name = \"EARTH BARYCENTER\""});
  write("other.toml", from_message(opm) + "[ephemeris]\ncenter_name = \"EARTH BARYCENTER\"\n");
  succeed({"check", "other.toml"});
  // Another published value of the Earth's mu is the Earth's.
  write("other.opm", changed(state_alone(), "398600.4415", "398600.8"));
  write("other.toml", from_message(opm));
  succeed({"check", "other.toml"});
  // An ephemeris has no GM, but a centre.
  write("other.oem", changed(low_orbit, "= Earth", "= Moon"));
  refuse(from_message("oem_file = \"other.oem\"\n"),
         {"nominal.oem_file: another centre", "CENTER_NAME = Moon in other.oem:11"});
}

TEST_F(OrbitMessages, TheStateMustBeThere) {
  const auto refuse = [&](const std::string& nominal, const std::vector<std::string>& words) {
    write("bad.toml", from_message(nominal));
    expect_error({"check", "bad.toml"}, 3, words);
  };
  const std::string low = "oem_file = \"low.oem\"\n";
  refuse(low + "epoch = \"2020-06-01T12:01:20\"\n",
         {"bad.toml:10:9: nominal.epoch: no state of this epoch is in the file",
          "the nearest is 2020-06-01T12:01:00.000000000000"});
  refuse(low + "epoch = \"yesterday\"\n", {"nominal.epoch: no moment of the calendar"});
  refuse(low + "object = \"OTHER\"\n",
         {"nominal.object: not in the file, got \"OTHER\", must be one of: TEST_OBJ"});
  refuse(low + "a_km = 7000\n",
         {"nominal.oem_file: both forms of an orbit, got a_km and oem_file"});
  refuse(low + "opm_file = \"standard.opm\"\n", {"must be exactly one of: oem_file, opm_file"});
  refuse("epoch = \"2020-06-01T12:01:00\"\n", {"must be exactly one of: oem_file, opm_file"});
  refuse("oem_file = \"\"\n", {"nominal.oem_file: no path"});
  refuse("opm_file = \"standard.opm\"\nepoch = \"2021-06-04T00:00:00\"\n",
         {"nominal.epoch: not that of the message"});
  // Of the standard's own example only states for interpolation are printed in the first block.
  refuse("oem_file = \"standard.oem\"\nepoch = \"2019-12-18T12:01:00.331\"\n",
         {"nominal.epoch: no state of this epoch", "2019-12-28T21:29:07.267"});
  write("two.oem", changed(io::standard_oem, "OBJECT_NAME = MARS", "OBJECT_NAME = OTHER"));
  refuse("oem_file = \"two.oem\"\n", {"nominal.object: missing, got a file of 2 objects",
                                      "OTHER GLOBAL SURVEYOR, MARS GLOBAL SURVEYOR"});
  refuse("oem_file = \"two.oem\"\nobject = \"ANOTHER\"\n",
         {"must be one of: OTHER GLOBAL SURVEYOR, MARS GLOBAL SURVEYOR"});
  // The two have one name but are different.
  write("two.oem", changed(io::standard_oem, "OBJECT_ID = 1996-062A", "OBJECT_ID = 1996-062B"));
  refuse("oem_file = \"two.oem\"\n",
         {"nominal.object: missing, got a file of 2 objects", "1996-062B, 1996-062A"});
  refuse("oem_file = \"two.oem\"\nobject = \"MARS GLOBAL SURVEYOR\"\n",
         {"nominal.object: the name of 2 objects", "1996-062B, 1996-062A"});
}

// What is no scene is named, with the way to use it, and not taken for damaged TOML.
TEST_F(OrbitMessages, AMessageGivenAsASceneIsNamed) {
  const std::string elements =
      "1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753\n"
      "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667\n";
  write("vanguard.tle", elements);
  for (const char* command : {"check", "run", "motion"}) {
    expect_error({command, "standard.opm"}, 3,
                 {"standard.opm: no scene, got an orbit parameter message (OPM)",
                  "must be a scene that names it, as hamjet init --from writes it"});
    expect_error({command, "standard.oem"}, 3, {"no scene, got an orbit ephemeris message (OEM)"});
    expect_error({command, "vanguard.tle"}, 3,
                 {"no scene, got two-line elements (TLE), whose mean elements are valid with SGP4 "
                  "alone: must be a state"});
  }
  write("tle.toml", from_message("opm_file = \"vanguard.tle\"\n"));
  expect_error({"check", "tle.toml"}, 5, {"vanguard.tle:1: CCSDS_OPM_VERS: missing, got two-line"});
  write("oem.toml", from_message("oem_file = \"standard.opm\"\n"));
  expect_error({"check", "oem.toml"}, 5, {"got an orbit parameter message (OPM)", "opm_file"});
}

TEST_F(OrbitMessages, ADeputyOfTheSameAxesByAnotherNameOrEpoch) {
  const auto scene = [&](const std::string& chief, const std::string& deputy) {
    write("chief.opm", changed(state_alone(), "=   TOD", "= " + chief));
    write("deputy.opm",
          changed(changed(state_alone(), "=   TOD", "= " + deputy), "6655.9942", "6656.9942"));
    write("pair.toml",
          from_message("opm_file = \"chief.opm\"\n") + "[deputy]\nopm_file = \"deputy.opm\"\n");
  };
  const std::string of_then = "TOD\nREF_FRAME_EPOCH = 2021-06-03T00:00:00";
  scene("EME2000", "J2000");
  succeed({"check", "pair.toml"});
  scene("TOD", of_then);
  succeed({"check", "pair.toml"});
  scene("TOD\nREF_FRAME_EPOCH = 2020-06-03T00:00:00", "TOD");
  expect_error({"check", "pair.toml"}, 3,
               {"a state in other axes than the chief's, got TOD of date, must be TOD of "
                "2020-06-03T00:00:00.000000000000"});
  write("named.toml", from_message("opm_file = \"deputy.opm\"\n"));
  scene("TOD", "J2000");
  succeed({"check", "named.toml", "--set", "ephemeris.reference_frame=EME2000"});
}

}  // namespace
}  // namespace hamjet::test
