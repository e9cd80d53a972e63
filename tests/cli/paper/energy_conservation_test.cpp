#include <cmath>

#include "../command_test.hpp"

// Scenes of the study "energy-conservation": runs, stops, checks, and what is refused.

namespace hamjet::test {
namespace {

constexpr const char* kepler_scene = R"(schema = 1
title = "ellipse"
study = "energy-conservation"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 17500
e = 0.6
i_deg = 0
raan_deg = 0
argp_deg = 0
ta_deg = 0
[energy_conservation]
method = "midpoint"
first_step_canonical = 0.05
duration_orbits = 2
)";

class EnergyConservation : public CommandTest {
 protected:
  EnergyConservation() { write("ellipse.toml", kepler_scene); }

  CommandResult run(const std::vector<std::string>& overrides, int exit_code) {
    CommandResult result = hamjet(with_overrides({"run", "ellipse.toml", "-o", "out"}, overrides));
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    summary_ = read_json(directory_ / "out/summary.json");
    EXPECT_EQ(summary_["exit_code"], exit_code);
    return result;
  }

  /// One line on standard error that holds these words.
  static void expect_line(const CommandResult& result, const std::vector<std::string>& words) {
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& word : words) {
      EXPECT_NE(result.err.find(word), std::string::npos) << result.err << "lacks " << word;
    }
  }

  Json summary_;
};

// A place at which nothing is finite is not a stop of the method, even if a stop is expected.
TEST_F(EnergyConservation, OverflowIsNoExpectedStop) {
  write("ellipse.toml", R"(schema = 1
title = "overflow"
study = "energy-conservation"
[system]
model = "double-well"
[nominal]
position_m = [1e300]
momentum_kg_m_s = [0]
[energy_conservation]
method = "midpoint"
first_step_canonical = 0.05
duration_canonical = 2
expect = "stops"
)");
  const CommandResult result = run({}, 4);
  expect_line(result, {"step 0", "not finite"});
  const std::string points = content(directory_ / "out/trajectory.csv");
  EXPECT_EQ(points.find("nan"), std::string::npos) << points;
  EXPECT_EQ(points.find("inf"), std::string::npos) << points;
}

// Expected: the energy conserved to round-off; the orbit's own period 2 pi / (1 - e)^1.5; the files
// and the summary agree with one another.
TEST_F(EnergyConservation, RunsToTheEnd) {
  const CommandResult result = run({}, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(summary_["study"], "energy-conservation");
  EXPECT_EQ(summary_["method"], "midpoint");
  EXPECT_TRUE(summary_["stop"].is_null());
  const double period = 2 * M_PI / std::pow(0.4, 1.5);
  EXPECT_NEAR(summary_["duration_canonical"].get<double>(), 2 * period, 1e-12);
  EXPECT_GE(summary_["time_canonical"].get<double>(), 2 * period);
  EXPECT_LT(summary_["largest_discrete_energy_error"].get<double>(), 1e-14);
  EXPECT_GT(summary_["largest_energy_error"].get<double>(), 1e-4);
  EXPECT_GT(summary_["fixed_step"]["largest_energy_error"].get<double>(), 1e-3);
  EXPECT_EQ(summary_["fixed_step"]["steps"], summary_["steps"]);
  EXPECT_NE(result.out.find("step size"), std::string::npos);

  const Table table = read_table(directory_ / "out/trajectory.csv");
  EXPECT_EQ(table.header,
            "step,time_canonical,time_s,step_size_canonical,step_size_s,x,y,z,px,py,pz,"
            "discrete_energy_error,energy_error,condition,newton_iterations");
  ASSERT_EQ(table.rows.size(), summary_["steps"].get<std::size_t>() + 1);
  double smallest = INFINITY;
  for (std::size_t k = 0; k + 1 < table.rows.size(); ++k) {
    const double size = std::stod(table.rows[k][3]);
    smallest = std::min(smallest, size);
    EXPECT_NEAR(std::stod(table.rows[k + 1][1]), std::stod(table.rows[k][1]) + size, 1e-13);
  }
  EXPECT_EQ(smallest, summary_["smallest_step_canonical"].get<double>());
  EXPECT_EQ(table.rows.back()[3], "");  // no step starts there
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/fixed_step.csv"));
}

// Expected: the step size in the figure stands below the energies: two viewports of
// 500 each, with 40 for its title above each.
TEST_F(EnergyConservation, DrawsBothCharts) {
  run({}, 0);
  const std::string figure = content(directory_ / "out/figure.svg");
  // Below the first chart there is a note on the values that are drawn at the floor.
  EXPECT_NE(figure.find("height=\"1099\""), std::string::npos);
  EXPECT_NE(figure.find("<svg y=\"40\" width=\"900\" height=\"500\">"), std::string::npos);
  EXPECT_NE(figure.find("<svg y=\"599\" width=\"900\" height=\"500\">"), std::string::npos);
  for (const char* text :
       {"step size (s)", "energy error", "midpoint rule", "the rounding of double precision"}) {
    EXPECT_NE(figure.find(text), std::string::npos) << text;
  }
}

// Expected: above e = sqrt(5/8) the midpoint form stops where 2 x^2 - 3 x + 3 (1 - e^2) = 0, x =
// r/a: the predicted time is the Kepler equation's at that place.
TEST_F(EnergyConservation, StopsWithStepTimeAndCondition) {
  const CommandResult result =
      run({"nominal.e=0.85", "energy_conservation.first_step_canonical=0.001"}, 4);
  const Json& stop = summary_["stop"];
  expect_line(result, {"hamjet: energy-conserving midpoint: step ",
                       stop["step"].dump() + " at t = ", "H(z_m) - E",
                       "G = p.M^-1 V'' M^-1 p + g.M^-1 g", "changes sign"});
  EXPECT_EQ(stop["cause"], "no-root");
  EXPECT_EQ(stop["step"], summary_["steps"]);
  const double x = (3 - std::sqrt(24 * 0.85 * 0.85 - 15)) / 4;
  const double anomaly = std::acos((1 - x) / 0.85);
  const double predicted = (anomaly - 0.85 * std::sin(anomaly)) / std::pow(0.15, 1.5);
  EXPECT_NEAR(stop["predicted_time_canonical"].get<double>(), predicted, 1e-9);
  EXPECT_NEAR(stop["time_canonical"].get<double>(), predicted,
              1.5 * summary_["largest_step_canonical"].get<double>());
  EXPECT_NE(result.out.find("predicted"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/trajectory.csv"));
}

// A first step that has no solution is too large: nothing is said of a change of sign ahead, which
// the exact flow of an ellipse of e = 0.6 < sqrt(5/8) has not.
TEST_F(EnergyConservation, AFirstStepTooLargeIsNotSaidToMeetAChangeOfSign) {
  const CommandResult result = run({"energy_conservation.first_step_canonical=2"}, 4);
  expect_line(result, {"no solution near the start for the first step of 2; a smaller one may"});
  EXPECT_EQ(result.err.find("changes sign"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("not computed, for no step was taken"), std::string::npos)
      << result.out;
}

TEST_F(EnergyConservation, ExpectIsChecked) {
  const std::string eccentric = "nominal.e=0.85";
  const std::string stops = "energy_conservation.expect=stops";
  EXPECT_EQ(run({eccentric, stops}, 0).err, "");
  expect_line(run({stops}, 1), {"expect = \"stops\"", "it completed"});
  run({"energy_conservation.expect=completes"}, 0);
  // Earlier results are kept.
  const CommandResult stopped = hamjet(with_overrides(
      {"run", "ellipse.toml", "-o", "out"}, {eccentric, "energy_conservation.expect=completes"}));
  EXPECT_EQ(stopped.exit_code, 4) << stopped.err;
}

TEST_F(EnergyConservation, EnergyErrorIsChecked) {
  run({"energy_conservation.require_energy_error=1e-13"}, 0);
  expect_line(run({"energy_conservation.require_energy_error=1e-18"}, 1),
              {"require_energy_error", "the largest discrete energy error is"});
}

// Expected: every second point, the first and the last among them; steps are counted all.
TEST_F(EnergyConservation, LongTrajectoriesAreThinned) {
  run({"energy_conservation.first_step_canonical=0.0005"}, 0);
  EXPECT_GT(summary_["steps"].get<long>(), 20001);
  const Table table = read_table(directory_ / "out/trajectory.csv");
  EXPECT_LE(table.rows.size(), 20001U);
  EXPECT_GE(table.rows.size(), 10001U);
  EXPECT_EQ(table.rows.front()[0], "0");
  EXPECT_EQ(table.rows[1][0], "2");
  EXPECT_EQ(table.rows.back()[0], summary_["steps"].dump());
}

// A stop before the first step leaves no numbers to report, and no NaN.
TEST_F(EnergyConservation, NothingWasComputed) {
  run({"energy_conservation.first_step_canonical=20"}, 4);
  EXPECT_EQ(summary_["stop"]["cause"], "no-midpoint");
  EXPECT_TRUE(summary_["conserved_energy"].is_null());
  EXPECT_TRUE(summary_["largest_step_canonical"].is_null());
  const std::string text = content(directory_ / "out/summary.json");
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST_F(EnergyConservation, FlowJetsAreRefused) {
  const std::string why = "is not symplectic, because each neighbour takes its own steps";
  write("jet.toml", std::string(kepler_scene) + "[jet]\norder = 2\nduration_canonical = 1\n");
  expect_error({"run", "jet.toml"}, 3, {"jet.toml:18:1: jet: not available", why});
  write("list.toml", std::string(kepler_scene) + "[[integrator]]\nlabel = \"a\"\n");
  expect_error({"run", "list.toml"}, 3, {"list.toml:18:1: integrator: not available", why});
  for (const std::string method : {"energy-conserving-midpoint", "energy-conserving-stormer"}) {
    expect_error(
        {"run", "quick.toml", "--set", "integrator.midpoint.method=" + method}, 3,
        {"integrator.midpoint.method", "got \"" + method + "\"", "must be one of: gauss", why});
  }
  expect_error({"compare", "ellipse.toml"}, 3, {"study", "has no flow jet"});
}

TEST_F(EnergyConservation, BadKeys) {
  const auto refused = [&](const std::string& from, const std::string& to, int exit_code,
                           std::vector<std::string> words) {
    write("bad.toml", changed(kepler_scene, from, to));
    words.insert(words.begin(), "bad.toml:");
    expect_error({"run", "bad.toml"}, exit_code, words);
  };
  const std::string table = "energy_conservation.";
  refused("method = \"midpoint\"", "method = \"midpont\"", 3,
          {":15:10: " + table + "method: unknown value", "stormer, midpoint", "did you mean"});
  refused("method = \"midpoint\"\n", "", 3, {table + "method: missing"});
  refused("first_step_canonical = 0.05", "first_step_canonical = 0", 3,
          {":16:24: " + table + "first_step_canonical", "got 0"});
  refused("first_step_canonical = 0.05", "first_step_canonical = -1", 3, {"got -1"});
  refused("first_step_canonical = 0.05", "first_step_canonical = \"a\"", 3, {"wrong type"});
  refused("first_step_canonical = 0.05", "", 3,
          {"energy_conservation: missing", "first_step_canonical, first_step_s"});
  refused("first_step_canonical = 0.05", "first_step_canonical = 1\nfirst_step_s = 1", 3,
          {"first_step_s"});
  refused("first_step_canonical = 0.05", "first_step_canonical = 1e-6", 6,
          {"too many steps", "must be at least"});
  refused("first_step_canonical = 0.05", "first_step_canonical = 1e300", 3,
          {table + "first_step_canonical", "not be longer than the duration"});
  refused("duration_orbits = 2", "duration_orbits = 0", 3,
          {table + "duration_orbits: out of range, got 0, must not be 0"});
  refused("duration_orbits = 2", "", 3, {"duration_s, duration_orbits, duration_canonical"});
  refused("duration_orbits = 2", "duration_orbits = 2\nstep = 1", 3,
          {":18:1: " + table + "step: unknown key"});
  refused("duration_orbits = 2", "duration_orbits = 2\nexpect = \"stop\"", 3,
          {table + "expect: unknown value", "completes, stops", "did you mean stops?"});
  refused("duration_orbits = 2", "duration_orbits = 2\nrequire_energy_error = 0", 3,
          {table + "require_energy_error"});
  refused("[energy_conservation]", "[energy_conservaton]", 3,
          {"energy_conservaton: unknown key", "did you mean energy_conservation?"});
  refused("title = \"ellipse\"", "title = \"ellipse\"\nreference = 1", 3,
          {"reference: unknown key"});
  // Only keys that the study takes are offered.
  refused("title = \"ellipse\"", "title = \"ellipse\"\nwhatever = 1", 3,
          {"whatever: unknown key, got whatever, must be one of: schema, title, system, units, "
           "nominal, "
           "energy_conservation, study\n"});
}

}  // namespace
}  // namespace hamjet::test
