#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "formats/orbit_message_samples.hpp"
#include "scene_samples.hpp"
#include "support/temporary_directory.hpp"

// Input that can be computed but is almost surely not what was meant causes a warning. Expected:
// the bodies' numbers in other units, from their published values.

namespace hamjet::io {
namespace {

std::vector<std::string> warnings(const std::string& scene) {
  return parse_scene(scene, "file.toml").warnings;
}

void expect_warning(const std::string& scene, const std::vector<std::string>& words) {
  const auto found = warnings(scene);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].find('\n'), std::string::npos);
  for (const std::string& word : words) {
    EXPECT_NE(found[0].find(word), std::string::npos) << found[0] << "\nlacks " << word;
  }
}

TEST(LikelySlips, AGoodSceneHasNone) {
  EXPECT_TRUE(warnings(orbit).empty());
  EXPECT_TRUE(warnings(oscillator).empty());
  // Mars, the Moon's distance, an orbit of Jupiter about the Sun, and canonical units.
  EXPECT_TRUE(
      warnings(changed(changed(orbit, "398600.4415", "42828.37"), "6378", "3396.2")).empty());
  EXPECT_TRUE(warnings(changed(orbit, "[7000, 0, 0]", "[384400, 0, 0]")).empty());
  EXPECT_TRUE(warnings(changed(changed(changed(orbit, "398600.4415", "1.32712440018e11"),
                                       "[7000, 0, 0]", "[7.78e8, 0, 0]"),
                               "6378", "695700"))
                  .empty());
  EXPECT_TRUE(
      warnings(changed(changed(changed(orbit, "398600.4415", "1"), "[7000, 0, 0]", "[1, 0, 0]"),
                       "6378", "0.9"))
          .empty());
}

TEST(LikelySlips, MetresForKilometres) {
  expect_warning(changed(orbit, "[7000, 0, 0]", "[7000000, 0, 0]"),
                 {"warning: file.toml:9:15: nominal.position_km: 7,000,000 km from the centre are",
                  "1097 radii of EARTH", "it must be 7000 km"});
  // The semi-major axis decides, wherever the start lies on a long ellipse.
  expect_warning(changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]",
                         "a_km = 7_000_000\ne = 0.9\ni_deg = 0\nraan_deg = 0\nargp_deg = 0\n"
                         "ta_deg = 0"),
                 {"file.toml:9:8: nominal.a_km: 7,000,000 km from", "it must be 7000 km"});
  expect_warning(changed(orbit, "radius_km = 6378", "radius_km = 6378136.3"),
                 {"file.toml:6:13: system.radius_km: 6378136.3 is the radius of EARTH in metres",
                  "in kilometres it is 6378.1363"});
  expect_warning(
      changed(orbit, "398600.4415", "3.986004415e14"),
      {"file.toml:5:13: system.mu_km3_s2", "mu of EARTH in m^3/s^2", "it is 398600.4415"});
}

TEST(LikelySlips, AnotherBodysMu) {
  expect_warning(changed(orbit, "398600.4415", "42828.37"),
                 {"system.radius_km: 6378 beside the mu of MARS", "3396.19 km"});
}

TEST(LikelySlips, AMuThatNoBodyHasBesideABodysRadius) {
  expect_warning(changed(orbit, "398600.4415", "3986.004415"),
                 {"file.toml:5:13: system.mu_km3_s2: 3986.004415 beside the radius of EARTH",
                  "whose mu is 398600.4355"});
  EXPECT_TRUE(warnings(changed(orbit, "398600.4415", "4e5")).empty());
}

TEST(LikelySlips, AHeightInPlaceOfTheSemiMajorAxis) {
  const auto with = [](const char* a_km) {
    return changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]",
                   std::string("a_km = ") + a_km +
                       "\ne = 0\ni_deg = 0\nraan_deg = 0\nargp_deg = 0\nta_deg = 0");
  };
  expect_warning(with("700"), {"file.toml:9:8: nominal.a_km: 700 km from the centre",
                               "below the surface at 6378.14 km of EARTH", "must be 7078.14 km"});
  EXPECT_TRUE(warnings(with("6500")).empty());
}

TEST(LikelySlips, AHeightInMetres) {
  const auto with = [](const char* size) {
    return changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]",
                   std::string(size) + "\ni_deg = 0\nraan_deg = 0\nu_deg = 0");
  };
  expect_warning(with("height_km = 35786000"),
                 {"file.toml:9:13: nominal.height_km: 35,786,000 km above the surface are",
                  "5611 radii of EARTH; if these are metres, it must be 35786 km"});
  EXPECT_TRUE(warnings(with("height_km = 35786")).empty());
  EXPECT_TRUE(warnings(with("period_s = 86164\ne = 0")).empty());
}

TEST(LikelySlips, MetresPerSecondForKilometresPerSecond) {
  expect_warning(changed(orbit, "[0, 7.5, 1]", "[0, 7500, 1000]"),
                 {"file.toml:10:17: nominal.velocity_km_s: 7566.37 km/s are 709 times the speed of "
                  "escape",
                  "must be 7.56637 km/s"});
  EXPECT_TRUE(warnings(changed(orbit, "[0, 7.5, 1]", "[0, 75, 10]")).empty());
}

TEST(LikelySlips, AJ2ThatNoPlanetHas) {
  expect_warning(changed(orbit, "J2 = 1e-3", "J2 = 0.108"),
                 {"file.toml:7:6: system.J2: 0.108 is more than that of every planet"});
  EXPECT_TRUE(warnings(changed(orbit, "J2 = 1e-3", "J2 = 0.0163")).empty());
}

TEST(LikelySlips, ANegativeJ2OfABodysSize) {
  expect_warning(changed(orbit, "J2 = 1e-3", "J2 = -1.08e-3"),
                 {"file.toml:7:6: system.J2: -0.00108", "J2 = -C20", "positive: 0.00108"});
  EXPECT_TRUE(warnings(changed(orbit, "J2 = 1e-3", "J3 = -2.5e-6")).empty());
  EXPECT_TRUE(warnings(changed(orbit, "J2 = 1e-3", "J2 = -1e-9")).empty());
}

/// The warnings of a scene about the Earth that starts from this message.
std::vector<std::string> warnings_of_message(const std::string& message) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory.path() / "start.opm") << message;
  const std::string scene =
      changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n",
              "opm_file = \"start.opm\"\n");
  return parse_scene(scene, (directory.path() / "file.toml").string()).warnings;
}

// The standard's own example has the size of its orbit right, a = 41399.5116 km by the vis-viva
// integral, and its place by the elements is 1157 km from the state's (computed in another language
// from r = p/(1 + e cos nu) and the three rotations).
TEST(LikelySlips, ElementsThatAreNotThoseOfTheStateAreTold) {
  const std::string without(io::standard_opm,
                            std::string(io::standard_opm).find("COMMENT Keplerian"));
  EXPECT_TRUE(warnings_of_message(without).empty());
  const auto found = warnings_of_message(io::standard_opm);
  ASSERT_EQ(found.size(), 1U);
  for (const char* words :
       {"warning: ",
        "nominal.opm_file: Keplerian elements that are not those of the state, got "
        "SEMI_MAJOR_AXIS = 41399.5123 km in ",
        "start.opm:25 and a place 1160 km from the state's", "whose own is 41399.512 km",
        "the state is used"}) {
    EXPECT_NE(found[0].find(words), std::string::npos) << found[0];
  }
  // A polar circle that is given by its mean anomaly.
  const std::string right =
      without +
      "SEMI_MAJOR_AXIS = 7000\nECCENTRICITY = 0\nINCLINATION = 90\nRA_OF_ASC_NODE = 0\n"
      "ARG_OF_PERICENTER = 0\nMEAN_ANOMALY = 0\nGM = 398600.4415\n";
  std::string polar = changed(right, "6655.9942        [km]", "7000");
  polar = changed(polar, "-40218.5751        [km]", "0");
  polar = changed(polar, "-82.9177        [km]", "0");
  polar = changed(polar, "3.11548208    [km/s]", "0");
  polar = changed(polar, "0.47042605    [km/s]", "0");
  // sqrt(mu/a) of the circle.
  polar = changed(polar, "-0.00101495    [km/s]", "7.5460533");
  EXPECT_TRUE(warnings_of_message(polar).empty());
  EXPECT_EQ(warnings_of_message(changed(polar, "AXIS = 7000", "AXIS = 7010")).size(), 1U);
  EXPECT_EQ(warnings_of_message(changed(polar, "ANOMALY = 0", "ANOMALY = 0.1")).size(), 1U);
  EXPECT_EQ(warnings_of_message(changed(polar, "ECCENTRICITY = 0", "ECCENTRICITY = 1.5")).size(),
            1U);
  EXPECT_EQ(
      warnings_of_message(changed(polar, "= 7000\nECCENTRICITY = 0", "= -7000\nECCENTRICITY = 1.5"))
          .size(),
      1U);
}

TEST(LikelySlips, NumbersOfAMessageThatAreNotUsedAreTold) {
  const std::string without(io::standard_opm,
                            std::string(io::standard_opm).find("COMMENT Keplerian"));
  const auto found = warnings_of_message(without + "MASS = 1913 [g]\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(
      found[0].find("start.opm:24: MASS: wrong unit, got \"[g]\", must be [kg]; it is not used"),
      std::string::npos)
      << found[0];
}

}  // namespace
}  // namespace hamjet::io
