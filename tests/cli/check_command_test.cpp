#include <sstream>
#include <string>
#include <vector>

#include "command_test.hpp"

// What the command says of a scene before anything is computed.

namespace hamjet::test {
namespace {

using CheckCommand = CommandTest;

// One run tells all mistakes, a line each in the order of the lines, and writes nothing.
TEST_F(CheckCommand, AllMistakesOfASceneTogether) {
  std::string scene = changed(small_scene, "mu_km3_s2 = 398600.4415", "mu_km3_s2 = 0");
  scene = changed(scene, "title = \"small\"", "titel = 1");
  write("bad.toml", changed(scene, "method = \"gauss\"", "method = \"guass\""));
  const auto before = files();
  const auto result = hamjet({"run", "bad.toml"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(files(), before);
  std::vector<std::string> lines;
  std::istringstream text(result.err);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 3U) << result.err;
  EXPECT_TRUE(lines[0].starts_with("hamjet: bad.toml:2:1: titel: unknown key")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("hamjet: bad.toml:5:13: system.mu_km3_s2: not pos")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("hamjet: bad.toml:18:10: integrator.0.method: ")) << lines[2];
}

// What the scene means: the heights follow from a (1 -+ e) and the radius.
TEST_F(CheckCommand, CheckSaysWhatTheOrbitIs) {
  write("orbit.toml",
        "system = {model = \"kepler\", mu_km3_s2 = 398600.4415}\n"
        "nominal = {a_km = 7000, e = 0.2, i_deg = 98, raan_deg = 0, argp_deg = 0, ta_deg = 0}\n"
        "jet = {duration_orbits = 3}\n");
  const auto result = hamjet({"check", "orbit.toml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"title        orbit", "3 revolutions", "inclination 98.0000 deg", "perigee      5600.00 km",
        "apogee       8400.00 km from the centre, 2021.86 km above the surface",
        "goes below the surface within the duration, to 778.14 km under it",
        "gauss8: gauss, 8 stages, tolerance 1e-12"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << result.out << "lacks " << words;
  }
}

}  // namespace
}  // namespace hamjet::test
