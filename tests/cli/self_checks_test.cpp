#include <cmath>

#include "command_test.hpp"

// Self-checks as a user meets them: in summary.json, on the terminal, in the exit code.

namespace hamjet::test {
namespace {

class SelfChecks : public CommandTest {
 protected:
  Json run(const std::string& scene, const std::vector<std::string>& overrides, int exit_code) {
    result_ = hamjet(with_overrides({"run", scene, "-o", "results"}, overrides));
    EXPECT_EQ(result_.exit_code, exit_code) << result_.err << result_.out;
    return read_json(directory_ / "results/summary.json");
  }

  static Json check(const Json& run, const std::string& name) {
    for (const Json& entry : run["checks"]) {
      if (entry["name"] == name) return entry;
    }
    ADD_FAILURE() << "no check " << name;
    return {};
  }

  void expect_printed(const std::string& text, bool is_there = true) const {
    EXPECT_EQ(in_one_line(result_.out).find(text) != std::string::npos, is_there) << text << "\n"
                                                                                  << result_.out;
  }

  CommandResult result_;
};

const std::string fixed_midpoint = "integrator=[{label=\"a\", method=\"gauss\", stages=1, ";

TEST_F(SelfChecks, StandInTheSummary) {
  const Json summary = run("quick.toml", {}, 0);
  const std::vector<std::string> names = {"finite",  "convergence",   "step-error",
                                          "energy",  "symplecticity", "inversion",
                                          "surface", "error-estimate"};
  for (const Json& entry : summary["runs"]) {
    ASSERT_EQ(entry["checks"].size(), names.size());
    EXPECT_TRUE(entry["failed_checks"].empty());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Json& check = entry["checks"][i];
      EXPECT_EQ(check.size(), 6U);
      EXPECT_EQ(check["name"], names[i]);
      EXPECT_FALSE(check["text"].get<std::string>().empty());
      EXPECT_GE(check["seconds"], 0);
      if (names[i] == "surface") {  // Kepler's problem has no radius
        EXPECT_EQ(check["state"], "not applicable");
        EXPECT_TRUE(check["value"].is_null());
        EXPECT_TRUE(check["limit"].is_null());
      } else {
        EXPECT_EQ(check["state"], "passed") << check;
        EXPECT_TRUE(check["value"].is_number()) << check;
      }
    }
  }
  expect_printed("CHECK FAILED", false);
  expect_printed("turned off", false);
}

TEST_F(SelfChecks, FailedOneMarksTheResultAndKeepsIt) {
  const Json summary = run("quick.toml", {"checks.energy=1e-9"}, 1);
  EXPECT_EQ(summary["exit_code"], 1);
  const Json& midpoint = summary["runs"][1];
  EXPECT_EQ(check(midpoint, "energy")["state"], "failed");
  EXPECT_EQ(check(midpoint, "energy")["limit"], 1e-9);
  EXPECT_GT(check(midpoint, "energy")["value"], 1e-9);
  ASSERT_EQ(midpoint["failed_checks"].size(), 1U);
  expect_printed("CHECK FAILED: midpoint: energy: the energy along the nominal changed by");
  EXPECT_NE(result_.err.find("a check failed"), std::string::npos) << result_.err;
  EXPECT_EQ(check(summary["runs"][0], "energy")["state"], "passed");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "results/midpoint/jet.csv"));
}

TEST_F(SelfChecks, ThatTheSceneTurnsOffAreSaidToBeOff) {
  const Json summary =
      run("quick.toml", {"checks={energy=false, inversion=false, step-error=true}"}, 0);
  expect_printed("checks that the scene turned off: energy, inversion ");
  for (const Json& entry : summary["runs"]) {
    EXPECT_EQ(check(entry, "energy")["state"], "off");
    EXPECT_EQ(check(entry, "inversion")["state"], "off");
    EXPECT_EQ(check(entry, "inversion")["seconds"], 0);
    EXPECT_EQ(check(entry, "step-error")["state"], "passed");
  }
}

TEST_F(SelfChecks, FailedRunHasNone) {
  const Json summary = run(
      "quick.toml",
      {"nominal={position_km=[10000, 0, 0], velocity_km_s=[0, 0, 0]}", "jet.duration_canonical=2"},
      4);
  for (const Json& entry : summary["runs"]) {
    EXPECT_TRUE(entry["error"].is_string());
    EXPECT_TRUE(entry["checks"].is_null());
  }
}

TEST_F(SelfChecks, CoarseStepsAreMarked) {
  const Json summary =
      run("quick.toml", {"generating_function=null", fixed_midpoint + "step_canonical=0.5}]"}, 1);
  EXPECT_EQ(check(summary["runs"][0], "step-error")["state"], "failed");
  EXPECT_EQ(check(summary["runs"][0], "symplecticity")["state"], "passed");
  expect_printed("CHECK FAILED: a: step-error: ");
}

TEST_F(SelfChecks, UnstableVerletIsMarked) {
  write("perigee.toml", R"(schema = 1
title = "Verlet beyond its limit at perigee"
)" + perigee_tables + R"([jet]
order = 1
duration_canonical = 12
[[integrator]]
label = "verlet"
method = "velocity-verlet"
step_canonical = 0.1
)");
  // The orbit, of energy -0.5, is left at its first perigee, where omega tau is 4.4.
  const Json energy = check(run("perigee.toml", {}, 1)["runs"][0], "energy");
  EXPECT_EQ(energy["state"], "failed");
  EXPECT_GT(energy["value"], 1);
  run("perigee.toml", {"integrator.verlet.step_canonical=0.001"}, 0);
}

TEST_F(SelfChecks, PerigeeBelowTheSurface) {
  const std::string orbit =
      "nominal={a_km=8000, e=0.25, i_deg=30, raan_deg=0, argp_deg=0, ta_deg=180}";
  const std::vector<std::string> scene = {
      "generating_function=null", orbit, "jet={order=1, duration_orbits=1}",
      "integrator=[{label=\"a\", method=\"gauss\", stages=12, tolerance=1e-12}]"};
  auto with_radius = scene;
  with_radius.emplace_back(
      "system={model=\"zonal-gravity\", mu_km3_s2=398600.4415, radius_km=6378}");
  const Json summary = run("quick.toml", with_radius, 1);
  const Json surface = check(summary["runs"][0], "surface");
  EXPECT_EQ(surface["state"], "failed");
  EXPECT_NEAR(surface["value"], 6000, 1e-3);  // a (1 - e)
  EXPECT_EQ(surface["limit"], 6378);
  // Half a period: pi sqrt(a^3 / mu) = 3560.5 s.
  expect_printed(
      "CHECK FAILED: a: surface: the nominal passes 378 km below the surface at t = 3560.");
  with_radius.emplace_back("checks.surface=5999");
  EXPECT_EQ(check(run("quick.toml", with_radius, 0)["runs"][0], "surface")["state"], "passed");
}

TEST_F(SelfChecks, MistakesInTheTable) {
  expect_error({"run", "quick.toml", "--set", "checks.energy=\"none\""}, 3,
               {"checks.energy", "a number above 0", "true or false"});
  expect_error({"run", "quick.toml", "--set", "checks.enrgy=false"}, 3,
               {"checks.enrgy: unknown key", "did you mean energy?"});
  expect_error({"run", "quick.toml", "--set", "checks.surface=6378"}, 3,
               {"checks.surface", "system.radius_km"});
}

// F1 of Kepler's problem does not exist after a whole revolution. Close to it the map is right to
// its rounding, and F1 is not.
TEST_F(SelfChecks, AKindNearItsSingularTimeIsSaidToBe) {
  write("circle.toml", "schema = 1\ntitle = \"circle\"\n" + std::string(R"([system]
model = "kepler"
mu_km3_s2 = 1
[nominal]
position_km = [1, 0, 0]
velocity_km_s = [0, 1, 0]
[jet]
order = 2
duration_canonical = 1
[generating_function]
kinds = ["F1"]
)") + gauss8("tolerance = 1e-13"));
  const std::string words = "F1 is near one of its singular times: it amplifies the error";
  const Json far = run("circle.toml", {"jet.duration_canonical=5.28"}, 0);
  expect_printed(words, false);
  EXPECT_EQ(check(far["runs"][0], "inversion")["text"].get<std::string>().find(words),
            std::string::npos);
  // After 200 revolutions the map is large, which makes no kind singular.
  run("circle.toml", {"jet.duration_canonical=1258.5", "generating_function.kinds=[\"auto\"]"}, 0);
  expect_printed("is near one of its singular times", false);
  const Json near = run("circle.toml", {"jet.duration_canonical=6.2831854"}, 0);
  expect_printed("WARNING: gauss8: " + words);
  EXPECT_NE(check(near["runs"][0], "inversion")["text"].get<std::string>().find(words),
            std::string::npos);
}

}  // namespace
}  // namespace hamjet::test
