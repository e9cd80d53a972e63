#include <cmath>

#include "../support/reference_data.hpp"
#include "command_test.hpp"

// Outcomes of a run: checks, failures, special durations, subspaces, precision.

namespace hamjet::test {
namespace {

class Outcomes : public CommandTest {
 protected:
  /// Runs the scene with these overrides into `results`; returns the summary.
  Json run(const std::string& scene, const std::vector<std::string>& overrides, int exit_code = 0) {
    result_ = hamjet(with_overrides({"run", scene, "-o", "results"}, overrides));
    EXPECT_EQ(result_.exit_code, exit_code) << result_.err;
    EXPECT_EQ(result_.err.empty(), exit_code == 0) << result_.err;
    return read_json(directory_ / "results/summary.json");
  }
  bool exists(const std::string& name) const {
    return std::filesystem::exists(directory_ / "results" / name);
  }
  void expect_printed(const std::string& text) const {
    EXPECT_NE(in_one_line(result_.out).find(text), std::string::npos) << text << "\n"
                                                                      << result_.out;
  }

  CommandResult result_;
};

std::vector<double> state_of(const Json& summary, std::size_t run = 0) {
  return summary["runs"][run]["nominal_final"].get<std::vector<double>>();
}

TEST_F(Outcomes, FailedCheck) {
  const Json summary = run("small.toml",
                           {"integrator.midpoint.require_relative_error=1e-30",
                            "integrator.gauss8.require_symplecticity=1e-9"},
                           1);
  expect_printed("CHECK FAILED: midpoint: require_relative_error");
  EXPECT_EQ(result_.out.find("CHECK FAILED: gauss8"), std::string::npos);
  EXPECT_NE(result_.err.find("a check failed"), std::string::npos);
  EXPECT_EQ(summary["exit_code"], 1);
  EXPECT_EQ(summary["runs"][0]["failed_checks"].size(), 0U);
  ASSERT_EQ(summary["runs"][1]["failed_checks"].size(), 1U);
  EXPECT_TRUE(exists("midpoint/jet.csv"));  // the results exist nevertheless
}

TEST_F(Outcomes, FailedCheckIsToldThoughQuiet) {
  const CommandResult result =
      hamjet({"run", "small.toml", "-q", "--set", "integrator.gauss8.require_symplecticity=1e-30"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("out/small/summary.json"), std::string::npos) << result.err;
}

TEST_F(Outcomes, KindThatDoesNotExistAtTheTime) {
  // After a whole revolution of a Kepler orbit the final position depends on the initial momentum
  // through the period alone: dq/dp0 has rank 1, and F1 does not exist.
  const Json summary = run("quick.toml",
                           {"jet={order=2, duration_orbits=1}",
                            "integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]",
                            "generating_function.kinds=[\"F1\", \"F2\", \"auto\"]"},
                           4);
  EXPECT_EQ(summary["exit_code"], 4);
  const Json& exactness = summary["runs"][0]["exactness"];
  EXPECT_TRUE(exactness[0]["error"].is_string());
  EXPECT_TRUE(exactness[0]["by_degree"].is_null());
  EXPECT_TRUE(exactness[1]["error"].is_null());
  EXPECT_TRUE(exactness[2]["error"].is_null());
  EXPECT_FALSE(exists("gauss8/generating_function_F1.csv"));
  EXPECT_TRUE(exists("gauss8/generating_function_F2.csv"));
  EXPECT_TRUE(exists("gauss8/jet.csv"));
  expect_printed("NOT COMPUTED: gauss8: generating function");
  EXPECT_NE(result_.err.find("a numerical failure"), std::string::npos) << result_.err;
  // Kepler's third law: the nominal is back at its start.
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(state_of(summary)[i], summary["nominal_initial"][i], 1e-12);
  }
}

const std::string fall = "nominal={position_km=[10000, 0, 0], velocity_km_s=[0, 0, 0]}";

TEST_F(Outcomes, Collision) {
  // The fall from rest at distance 1 ends at t = pi / (2 sqrt 2) = 1.1107...
  const Json summary = run("quick.toml",
                           {fall, "jet.duration_canonical=2",
                            "integrator=[{label=\"adaptive\", method=\"gauss\", tolerance=1e-13},"
                            "{label=\"coarse\", method=\"gauss\", stages=1, step_canonical=0.01},"
                            "{label=\"explicit\", method=\"fehlberg78\", tolerance=1e-10},"
                            "{label=\"blind\", method=\"fehlberg78\", step_canonical=0.01}]"},
                           4);
  for (const Json& entry : summary["runs"]) {
    const std::string label = entry["label"];
    ASSERT_TRUE(entry["error"].is_string()) << label;
    expect_printed(label);
    expect_printed("FAILED: " + label + ": " + entry["error"].get<std::string>());
    EXPECT_FALSE(exists(label)) << label;
  }
  const std::string message = summary["runs"][0]["error"];
  EXPECT_NE(message.find("collision"), std::string::npos) << message;
  EXPECT_NE(message.find("t = 1.1107"), std::string::npos) << message;
}

TEST_F(Outcomes, CollisionAheadOfTheReference) {
  // The runs that end before the collision, or all of them, are not lost with the reference.
  const Json summary = run("small.toml", {fall, "jet.duration_canonical=2"}, 4);
  const auto failure = summary["reference_error"].get<std::string>();
  EXPECT_TRUE(failure.starts_with("reference: Gauss: ")) << failure;
  EXPECT_NE(failure.find("t = 1.1107"), std::string::npos) << failure;  // pi / (2 sqrt 2)
  EXPECT_TRUE(summary["reference"].is_null());
  EXPECT_EQ(summary["runs"].size(), 2U);
}

TEST_F(Outcomes, EndlessDurationIsRefusedSoon) {
  for (const char* method : {"gauss", "fehlberg78"}) {
    expect_error({"run", "quick.toml", "--set", "jet.duration_canonical=1e300", "--set",
                  std::string("integrator.gauss8.method=") + method, "--set",
                  "integrator.gauss8.stages=null", "--set", "integrator.midpoint=null"},
                 6, {"steps would be needed", "1e+08"});
  }
}

// Rounding leaves degree 4 some 1e-7 of itself, far more than the tolerance allows.
TEST_F(Outcomes, TheVerdictSaysWhichDegreesKeepTheTolerance) {
  write("tight.toml",
        "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
        "J2 = 1.0826e-3\nJ3 = -2.53e-6\n[nominal]\na_km = 60000\ne = 0.88\ni_deg = 50\n"
        "raan_deg = 0\nargp_deg = 30\nta_deg = 0\n[jet]\norder = 4\nduration_orbits = 4.5\n"
        "[[integrator]]\nlabel = \"g\"\nmethod = \"gauss\"\ntolerance = 1e-13\n");
  const CommandResult result = hamjet({"run", "tight.toml", "-o", "tight"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("  ok to degree "), std::string::npos) << result.out;
  EXPECT_NE(in_one_line(result.out).find("what keeps it from it is rounding"), std::string::npos)
      << result.out;
}

TEST_F(Outcomes, FailedRunKeepsEarlierResults) {
  run("quick.toml", {fall, "jet.duration_canonical=0.5"});
  EXPECT_TRUE(exists("midpoint/jet.csv"));
  // From 0.5 to 2 both runs fail: what was good stays, and its summary with it.
  const CommandResult failed = hamjet(
      with_overrides({"run", "quick.toml", "-o", "results"}, {fall, "jet.duration_canonical=2"}));
  EXPECT_EQ(failed.exit_code, 4);
  EXPECT_TRUE(exists("midpoint/jet.csv"));
  EXPECT_TRUE(exists("gauss8/jet.csv"));
}

TEST_F(Outcomes, DurationZeroIsTheIdentity) {
  for (const std::string zero : {"0", "0.0", "-0.0"}) {
    const Json summary = run("small.toml", {"jet.duration_canonical=" + zero,
                                            "generating_function.kinds=[\"F2\", \"F3\"]"});
    for (const char* label : {"gauss8", "midpoint"}) {
      for (const auto& row : read_table(directory_ / "results" / label / "jet.csv").rows) {
        const double coefficient = std::stod(row.back());
        const std::vector<std::string> components = {"x", "y", "z", "px", "py", "pz"};
        const auto c = static_cast<std::size_t>(
            std::find(components.begin(), components.end(), row[0]) - components.begin());
        const bool is_own_variable = degree(row) == 1 && row[1 + c] == "1";
        const double expected = degree(row) == 0 ? summary["nominal_initial"][c].get<double>()
                                                 : (is_own_variable ? 1 : 0);
        EXPECT_EQ(coefficient, expected);
      }
    }
    for (const Json& entry : summary["runs"][0]["error_by_degree"]) EXPECT_EQ(entry["relative"], 0);
  }
}

TEST_F(Outcomes, NegativeDurationGoesBack) {
  const std::string integrator =
      "integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]";
  const Json there = run("quick.toml", {integrator});
  // A second scene starts where the first ended: units in which mu and the distance are 1 keep the
  // numbers. Position and momentum are those of the first scene times the same unit.
  const auto end = state_of(there);
  const double radius = std::hypot(end[0], end[1], end[2]);
  std::string position, velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    position += nlohmann::json(end[i]).dump() + (i < 2 ? "," : "");
    velocity += nlohmann::json(end[3 + i]).dump() + (i < 2 ? "," : "");
  }
  const Json back = run(
      "quick.toml", {integrator, "system.mu_km3_s2=1",
                     "nominal={position_km=[" + position + "], velocity_km_s=[" + velocity + "]}",
                     "jet={order=2, duration_s=-1}"});
  for (std::size_t i = 0; i < 6; ++i) {
    const double unit = i < 3 ? radius : 1 / std::sqrt(radius);
    EXPECT_NEAR(state_of(back)[i] * unit, there["nominal_initial"][i], 1e-12);
  }
  EXPECT_LT(back["duration_canonical"], 0);
}

/// Scene in units where mu = 1 and the initial distance is 1, for a case of the reference data.
std::string scene_of(const ReferenceOrbit& orbit, const std::string& jet) {
  const auto number = [](double x) { return Json(x).dump(); };
  const auto triple = [&](std::size_t first) {
    return "[" + number(orbit.start[first]) + ", " + number(orbit.start[first + 1]) + ", " +
           number(orbit.start[first + 2]) + "]";
  };
  return "schema = 1\ntitle = \"" + orbit.id + "\"\n[system]\nmodel = \"zonal-gravity\"\n" +
         "mu_km3_s2 = 1\nradius_km = " + number(orbit.field.radius) +
         "\nJ2 = " + number(orbit.field.J[2]) + "\nJ3 = " + number(orbit.field.J[3]) +
         "\n[nominal]\nposition_km = " + triple(0) + "\nvelocity_km_s = " + triple(3) +
         "\n[jet]\nduration_canonical = " + number(orbit.duration) + "\n" + jet +
         "\n[[integrator]]\nlabel = \"gauss8\"\nmethod = \"gauss\"\ntolerance = 1e-14\n";
}

void expect_reference_state(const Json& summary, const ReferenceOrbit& orbit) {
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(state_of(summary)[i], static_cast<double>(orbit.state[i]),
                1e-12 + 10 * orbit.floor[i])
        << orbit.id << " component " << i;
  }
}

TEST_F(Outcomes, EquatorialOrbitWithoutJ3HasFourComponents) {
  const ReferenceOrbit orbit = reference_orbit("EQ-J2-CIRC");
  write("plane.toml", scene_of(orbit, "order = 2\nvariables = [\"x\", \"y\", \"px\", \"py\"]"));
  const Json summary = run("plane.toml", {"generating_function.kinds=[\"F1\", \"auto\"]"});
  EXPECT_EQ(summary["components"], Json({"x", "y", "px", "py"}));
  EXPECT_EQ(summary["runs"][0]["exactness"].size(), 2U);
  const Table jet = read_table(directory_ / "results/gauss8/jet.csv");
  EXPECT_EQ(jet.header, "component,e_x,e_y,e_z,e_px,e_py,e_pz,coefficient");
  EXPECT_EQ(jet.rows.size(), 4U * 15U);  // C(4 + 2, 2) = 15
  for (const auto& row : jet.rows) {
    EXPECT_NE(row[0], "z");
    EXPECT_NE(row[0], "pz");
    EXPECT_EQ(row[3] + row[6], "00");  // exponents of z and pz
  }
  expect_reference_state(summary, orbit);
  EXPECT_EQ(state_of(summary)[2], 0);
}

TEST_F(Outcomes, EquatorialOrbitWithJ3HasSixComponents) {
  // J3 pulls out of the equator: z = 2.3e-8 at the end.
  const ReferenceOrbit orbit = reference_orbit("EQ-J3");
  write("space.toml", scene_of(orbit, "order = 2\nvariables = [\"x\", \"y\", \"px\", \"py\"]"));
  const Json summary = run("space.toml", {});
  EXPECT_EQ(summary["components"].size(), 6U);
  EXPECT_EQ(read_table(directory_ / "results/gauss8/jet.csv").rows.size(), 6U * 15U);
  EXPECT_TRUE(summary["runs"][0]["symplecticity_by_degree"].is_null());
  expect_reference_state(summary, orbit);
  EXPECT_GT(state_of(summary)[2], 2e-8);
  // A generating function needs all variables of the space.
  expect_error({"run", "space.toml", "--set", "generating_function.kinds=[\"F1\"]"}, 3,
               {"generating_function.kinds", "variables"});
}

TEST_F(Outcomes, ExtendedPrecisionGivesMoreDigits) {
  const ReferenceOrbit& orbit = paper_orbit();
  write("extended.toml", scene_of(orbit, "order = 1"));
  run("extended.toml",
      {"precision=extended",
       "integrator=[{label=\"gauss12\", method=\"gauss\", stages=12, tolerance=1e-24}]"});
  std::size_t component = 0;
  for (const auto& row : read_table(directory_ / "results/gauss12/jet.csv").rows) {
    EXPECT_GT(row.back().size(), 36U);
    if (degree(row) != 0) continue;
    const Extended error = Extended(row.back()) - orbit.state[component++];
    EXPECT_LT(std::abs(static_cast<double>(error)), 1e-20) << row[0];
  }
  EXPECT_EQ(component, 6U);
}

}  // namespace
}  // namespace hamjet::test
