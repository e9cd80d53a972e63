#include <cmath>

#include "command_test.hpp"

// hamjet check --json: what would be computed, by the names of summary.json, and what is wrong.

namespace hamjet::test {
namespace {

class CheckJson : public CommandTest {
 protected:
  /// What it prints of a scene that is wrong; the one line is on standard error all the same.
  Json wrong(const std::vector<std::string>& arguments, int exit_code) const {
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.err.rfind("hamjet: ", 0), 0U);
    const Json said = Json::parse(result.out);
    EXPECT_EQ(said["exit_code"], exit_code);
    EXPECT_EQ(said["errors"].size(), 1U);
    return said;
  }
};

TEST_F(CheckJson, SaysWhatWouldBeComputed) {
  const Json said = Json::parse(succeed({"check", "quick.toml", "--json"}).out);
  EXPECT_EQ(said["file"], "quick.toml");
  EXPECT_EQ(said["exit_code"], 0);
  EXPECT_EQ(said["errors"], Json::array());
  EXPECT_EQ(said["order"], 2);
  // Monomials of degree up to 2 in 6 variables: 8 over 2.
  EXPECT_EQ(said["coefficients_per_component"], 28);
  EXPECT_EQ(said["kinds"], 2);
  EXPECT_EQ(said["reference"], false);
  ASSERT_EQ(said["integrators"].size(), 2U);
  EXPECT_EQ(said["integrators"][0]["label"], "gauss8");
  EXPECT_EQ(said["integrators"][1]["step_canonical"], 0.01);
  // One canonical unit of time, in which the circular orbit through the start takes 2 pi.
  const double length = said["units"]["length_km"];
  EXPECT_NEAR(said["duration_s"], std::sqrt(length * length * length / 398600.4415), 1e-9);
  EXPECT_GT(said["memory_bytes"], 0);
  for (const char* name : {"transfer", "validity", "deputies"}) EXPECT_TRUE(said[name].is_null());
  // What a run says of the scene, it says too.
  const Json summary = Json::parse(succeed({"run", "quick.toml", "--json"}).out);
  for (const char* name : {"scene", "title", "system", "units", "nominal_initial", "variables",
                           "components", "duration_canonical", "warnings"}) {
    EXPECT_EQ(said[name], summary[name]) << name;
  }
}

TEST_F(CheckJson, SaysWhereAMistakeIs) {
  write("a:1:2.toml", changed(quick_scene(), "order = 2", "order = 0"));
  const Json said = wrong({"check", "a:1:2.toml", "--json"}, 3);
  const Json& error = said["errors"][0];
  EXPECT_EQ(error["file"], "a:1:2.toml");
  EXPECT_EQ(error["line"], 14);
  EXPECT_EQ(error["column"], 9);
  EXPECT_EQ(error["key"], "jet.order");
  EXPECT_EQ(error["message"], "out of range, got 0, must be an integer from 1 to 20");
  write("no.toml", "schema = \n");
  const Json syntax = wrong({"check", "no.toml", "--json"}, 3)["errors"][0];
  EXPECT_EQ(syntax["line"], 1);
  EXPECT_TRUE(syntax["key"].is_null());
  EXPECT_EQ(syntax["message"].get<std::string>().rfind("not valid TOML: ", 0), 0U);
}

// What is warned of is no error, and is a text as in the summary of a run.
TEST_F(CheckJson, TellsWarningsFromMistakes) {
  write("warned.toml",
        changed(changed(quick_scene(), "mu_km3_s2 = 398600.4415", "mu_km3_s2 = 398600.4415e9"),
                "order = 2", "order = 0"));
  const Json said = wrong({"check", "warned.toml", "--json"}, 3);
  EXPECT_EQ(said["errors"][0]["key"], "jet.order");
  ASSERT_EQ(said["warnings"].size(), 1U);
  EXPECT_EQ(said["warnings"][0].get<std::string>().rfind("warning: warned.toml:", 0), 0U);
}

// An error is one line, for scripts; a warning is for people, and fits the terminal.
TEST_F(CheckJson, AWarningFitsTheTerminal) {
  write("warned.toml",
        changed(quick_scene(), "mu_km3_s2 = 398600.4415", "mu_km3_s2 = 398600.4415e9"));
  const CommandResult result = hamjet({"check", "warned.toml"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(in_one_line(result.err)
                .find("warned.toml:5:13: system.mu_km3_s2: 3.986e+14 is the mu of "
                      "EARTH in m^3/s^2; in km^3/s^2 it is"),
            std::string::npos)
      << result.err;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST_F(CheckJson, SaysWhatHasNoPlace) {
  const Json missing = wrong({"check", "missing.toml", "--json"}, 5)["errors"][0];
  EXPECT_EQ(missing["file"], "missing.toml");
  EXPECT_TRUE(missing["line"].is_null());
  EXPECT_TRUE(missing["key"].is_null());
  EXPECT_EQ(missing["message"], "the scene cannot be read: No such file or directory");
  const Json option =
      wrong({"check", "quick.toml", "--json", "--set", "jet.ordre=3"}, 3)["errors"][0];
  EXPECT_TRUE(option["file"].is_null());
  EXPECT_EQ(option["key"], "jet.ordre");
  EXPECT_NE(option["message"].get<std::string>().find("did you mean order?"), std::string::npos);
  options_.address_space = 65'000'000;
  const Json large =
      wrong({"check", "quick.toml", "--json", "--set", "jet.order=12"}, 6)["errors"][0];
  EXPECT_TRUE(large["file"].is_null());
  EXPECT_NE(large["message"].get<std::string>().find("18564 coefficients"), std::string::npos);
}

// A mistake in another file, which the scene names, is that file's.
TEST_F(CheckJson, SaysWhichFileIsWrong) {
  write("bad.opm", "CCSDS_OPM_VERS = 2.0\nNONSENSE = 1\n");
  const std::string orbit = quick_scene();
  const std::size_t begin = orbit.find("a_km");
  const std::size_t end = orbit.find("[jet]");
  write("message.toml", orbit.substr(0, begin) + "opm_file = \"bad.opm\"\n" + orbit.substr(end));
  const Json error = wrong({"check", "message.toml", "--json"}, 5)["errors"][0];
  EXPECT_EQ(error["file"], "bad.opm");
  EXPECT_EQ(error["line"], 2);
  EXPECT_EQ(error["key"], "NONSENSE");
}

TEST_F(CheckJson, KnowsStudiesWithoutAJet) {
  const std::string scene = HAMJET_SOURCE_DIR "/data/scenes/paper/free-end.toml";
  const Json said = Json::parse(succeed({"check", scene, "--json"}).out);
  EXPECT_EQ(said["exit_code"], 0);
  EXPECT_EQ(said["scene"], "free-end");
}

}  // namespace
}  // namespace hamjet::test
