#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../command_test.hpp"

// The study "optimal-control" as a user runs it. Expected values are the closed forms of the
// Heisenberg problem and of the double integrator.

namespace hamjet::test {
namespace {

constexpr const char* loop_scene = R"(schema = 1
study = "optimal-control"
title = "loop"
[optimal_control]
problem = "heisenberg"
method = "stormer"
duration = 2
steps = 24
refinements = [32, 64, 128]
start = [0, 0, 0]
end = [0, 0, 3]
shooting_intervals = 3
require_cost_error = 1e-12
require_equivalence = 1e-11
)";

class OptimalControl : public CommandTest {
 protected:
  OptimalControl() { write("loop.toml", loop_scene); }

  /// The loop with one setting changed must be refused with these words and this exit code.
  void refuse(const std::string& setting, int exit_code, const std::vector<std::string>& words) {
    expect_error({"run", "loop.toml", "-o", "out", "--set", "optimal_control." + setting},
                 exit_code, words);
  }
};

TEST_F(OptimalControl, WritesWhatItFound) {
  const CommandResult run = succeed({"run", "loop.toml", "-o", "out"});
  EXPECT_NE(run.out.find("rank 23 of 24"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("nullity 1"), std::string::npos) << run.out;
  const Json summary = read_json(directory_ / "out/summary.json");
  const double pi = std::numbers::pi;
  const double expected = 24 * std::tan(pi / 24) * 3 / 2;
  EXPECT_EQ(summary["study"], "optimal-control");
  EXPECT_EQ(summary["problem"], "heisenberg");
  EXPECT_EQ(summary["method"], "stormer");
  EXPECT_NEAR(summary["cost"].get<double>(), expected, 1e-12);
  EXPECT_NEAR(summary["squared_control"].get<double>(), 2 * expected, 1e-12);
  EXPECT_NEAR(summary["closed_form_continuous"].get<double>(), pi * 3 / 2, 1e-14);
  EXPECT_NEAR(summary["order"].get<double>(), 2, 0.01);
  EXPECT_EQ(summary["order_steps"], Json({128, 64, 32}));
  EXPECT_EQ(summary["shooting_nullity"], 1);
  EXPECT_EQ(summary["end_point_rank"], 2);
  EXPECT_LT(summary["route_difference"].get<double>(), 1e-13);
  EXPECT_LT(summary["symplecticity_defect"].get<double>(), 1e-15);
  EXPECT_EQ(summary["exit_code"], 0);
  EXPECT_TRUE(summary["routes_error"].is_null());

  const Table trajectory = read_table(directory_ / "out/trajectory.csv");
  EXPECT_EQ(trajectory.header, "step,time,x,y,z,p_x,p_y,p_z,u_1,u_2");
  ASSERT_EQ(trajectory.rows.size(), 25U);
  EXPECT_NEAR(std::stod(trajectory.rows.back()[4]), 3, 1e-12);
  EXPECT_EQ(trajectory.rows.back()[8], "");
  // Constant speed: |u|^2 is 2 cost / T at every step.
  for (std::size_t k = 0; k < 24; ++k) {
    const double u1 = std::stod(trajectory.rows[k][8]);
    const double u2 = std::stod(trajectory.rows[k][9]);
    EXPECT_NEAR(u1 * u1 + u2 * u2, expected, 1e-11);
  }
  const Table convergence = read_table(directory_ / "out/convergence.csv");
  ASSERT_EQ(convergence.rows.size(), 3U);
  EXPECT_EQ(convergence.rows[2][0], "128");
  EXPECT_NEAR(std::stod(convergence.rows[2][1]), 128 * std::tan(pi / 128) * 3 / 2, 1e-12);
}

TEST_F(OptimalControl, FreeEndHasItsClosedForm) {
  succeed({"run", "loop.toml", "-o", "out", "-q", "--set",
           "optimal_control={problem=\"double-integrator\", method=\"stormer\", duration=2, "
           "steps=10, start=[0, 0], free_end=[\"velocity\"], end=[1], require_cost_error=1e-12}"});
  const Json summary = read_json(directory_ / "out/summary.json");
  // 3 d^2 / (2 T^3 (1 - 1/n) (1 - 1/(2n)))
  EXPECT_NEAR(summary["cost"].get<double>(), 3.0 / 16 / (0.9 * 0.95), 1e-14);
  EXPECT_NEAR(summary["final_costate"][1].get<double>(), 0, 1e-14);
  EXPECT_EQ(summary["end"], Json({1, nullptr}));
  EXPECT_TRUE(summary["order"].is_null());
  EXPECT_EQ(summary["shooting_nullity"], 0);
}

TEST_F(OptimalControl, WrongSizesOfTheEndsSayTheRightOne) {
  refuse("start=[0, 0]", 3,
         {"optimal_control.start", "wrong size", "got 2 numbers", "must be 3", "x, y, z"});
  refuse("end=[0, 0, 1, 0]", 3,
         {"optimal_control.end", "wrong size", "got 4 numbers", "must be 3"});
  refuse("free_end=[\"z\"]", 3,
         {"optimal_control.end", "wrong size", "got 3 numbers", "must be 2", "free end", "x, y"});
  refuse("costate_guess=[1]", 3, {"costate_guess", "got 1 number,", "must be 3"});
  // The message comes from the file itself, with its place.
  write("wrong.toml", changed(loop_scene, "end = [0, 0, 3]", "end = [0, 3]"));
  expect_error({"run", "wrong.toml", "-o", "out"}, 3,
               {"wrong.toml:11:7: optimal_control.end: wrong size, got 2 numbers, must be 3"});
}

TEST_F(OptimalControl, MistakesAreNamed) {
  refuse("problem=\"brachistochrone\"", 3,
         {"optimal_control.problem", "brachistochrone", "heisenberg", "double-integrator"});
  refuse("method=\"euler\"", 3, {"optimal_control.method", "euler", "stormer", "midpoint"});
  refuse("steps=0", 3, {"optimal_control.steps", "got 0"});
  refuse("steps=2.5", 3, {"optimal_control.steps", "2.5"});
  refuse("duration=0", 3, {"optimal_control.duration", "got 0"});
  refuse("duration=-1", 3, {"optimal_control.duration", "-1"});
  refuse("start=[0, 0, nan]", 3, {"optimal_control.start", "nan"});
  refuse("refinements=[8, 0]", 3, {"optimal_control.refinements", "got 0"});
  refuse("refinements=[8, 8.5]", 3, {"optimal_control.refinements", "8.5"});
  refuse("shooting_intervals=25", 3, {"shooting_intervals", "got 25", "24"});
  refuse("free_end=[\"w\"]", 3, {"free_end", "unknown state", "\"w\"", "x, y, z"});
  refuse("free_end=[\"z\", \"z\"]", 3, {"free_end", "duplicate state"});
  refuse("free_end=[\"x\", \"y\", \"z\"]", 3, {"free_end", "at least one"});
  refuse("end=[1, 0, 3]", 3, {"require_cost_error", "no closed form"});
  refuse("stpes=3", 3, {"stpes", "steps"});
  refuse("steps=200000", 6, {"too many steps", "200032", "100000"});
  expect_error({"run", "loop.toml", "-o", "out", "--set", "jet.order=2"}, 3, {"jet"});
}

TEST_F(OptimalControl, FailedCheckKeepsTheResults) {
  const CommandResult run = hamjet({"run", "loop.toml", "-o", "out", "-q", "--set",
                                    "optimal_control.require_equivalence=1e-30"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("require_equivalence"), std::string::npos) << run.err;
  const Json summary = read_json(directory_ / "out/summary.json");
  EXPECT_EQ(summary["exit_code"], 1);
  EXPECT_EQ(summary["failed_checks"].size(), 1U);
}

// Two loops turn by 4 pi. The first conjugate time of a circle is when it has gone once around, the
// second at its turn of 8.9868, twice the first positive root of tan(w) = w; they are known up to a
// step. Once around, the end is conjugate itself; less than that is a least.
TEST_F(OptimalControl, AnExtremalThatIsNoLeastIsSaidToBeNone) {
  const auto second_order = [&](const std::string& scene, const std::string& guess, Json& summary) {
    std::vector<std::string> arguments = {
        "run",   std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/" + scene,
        "-o",    "out",
        "--set", "optimal_control.refinements=null",
        "--set", "optimal_control.require_cost_error=null"};
    if (!guess.empty()) {
      arguments.insert(arguments.end(), {"--set", "optimal_control.costate_guess=" + guess});
    }
    const std::string out = succeed(arguments).out;
    summary = read_json(directory_ / "out/summary.json");
    const std::size_t first = out.find("  second order ");
    return unwrapped(out.substr(first));
  };
  Json two;
  const std::string of_two = second_order("heisenberg-loop.toml", "[-3, 0, -6.3]", two);
  const double step = two["duration"].get<double>() / two["steps"].get<double>();
  const Json& times = two["conjugate_times_below"];
  ASSERT_EQ(times.size(), 2U);
  EXPECT_NEAR(times[0].get<double>(), 0.5, 1.01 * step);
  EXPECT_NEAR(times[1].get<double>(), 8.9868 / (4 * std::numbers::pi), 1.01 * step);
  EXPECT_EQ(two["local_least"], false);
  EXPECT_NE(of_two.find(fmt::format("no local least: a conjugate time before t = {:.6g}, 2 in all; "
                                    "another costate_guess may lead to a lesser cost",
                                    times[0].get<double>())),
            std::string::npos)
      << of_two;
  Json one;
  const std::string of_one = second_order("heisenberg-loop.toml", "", one);
  EXPECT_EQ(one["conjugate_times_below"], Json::array());
  EXPECT_TRUE(one["local_least"].is_null());
  EXPECT_NE(of_one.find("a least is not excluded, and not shown"), std::string::npos) << of_one;
  EXPECT_NEAR(two["cost"].get<double>() / one["cost"].get<double>(),
              std::tan(2 * std::numbers::pi / 64) / std::tan(std::numbers::pi / 64), 1e-12);
  Json line;
  const std::string of_line = second_order("heisenberg-line.toml", "", line);
  EXPECT_EQ(line["conjugate_times_below"], Json::array());
  EXPECT_EQ(line["local_least"], true);
  EXPECT_NE(of_line.find("a local least: no conjugate time up to the end"), std::string::npos)
      << of_line;
}

// From rest no direction of the costate lifts z to first order.
TEST_F(OptimalControl, NoConvergenceIsANumericalFailure) {
  refuse("costate_guess=[0, 0, 0]", 4, {"shooting", "iterations", "residual", "rank"});
}

// Unknowns that have run away satisfy the equations to their own rounding: no solution.
TEST_F(OptimalControl, RunawayIterationIsNoSolution) {
  for (const char* guess : {"[1e12, 1, 1]", "[1, 1e12, 1]", "[1, 1, 1e12]"}) {
    expect_error({"run", "loop.toml", "-o", "out", "--set",
                  std::string("optimal_control.costate_guess=") + guess, "--set",
                  "optimal_control.require_cost_error=null", "--set",
                  "optimal_control.require_equivalence=null"},
                 4, {"shooting"});
  }
  refuse("duration=1e300", 3, {"optimal_control.duration", "1e+30"});
}

// Results that an earlier run of another study left do not stay beside the new summary.
TEST_F(OptimalControl, EarlierResultsDoNotStayBehind) {
  succeed({"run", "loop.toml", "-o", "out", "-q"});
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/convergence.csv"));
  succeed({"run", "quick.toml", "-o", "out", "-q"});
  for (const char* file : {"convergence.csv", "trajectory.csv", "figure.svg"}) {
    EXPECT_FALSE(std::filesystem::exists(directory_ / "out" / file)) << file;
  }
}

// One step cannot enclose an area: that refinement has no solution, all else is there.
TEST_F(OptimalControl, FailedRefinementIsRecorded) {
  const CommandResult run = hamjet(
      {"run", "loop.toml", "-o", "out", "-q", "--set", "optimal_control.refinements=[1, 64]"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("convergence, 1 steps"), std::string::npos) << run.err;
  const Json summary = read_json(directory_ / "out/summary.json");
  EXPECT_TRUE(summary["convergence"][0]["cost"].is_null());
  EXPECT_FALSE(summary["convergence"][0]["error"].is_null());
  EXPECT_TRUE(summary["convergence"][1]["error"].is_null());
}

}  // namespace
}  // namespace hamjet::test
