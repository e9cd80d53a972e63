#include "../command_test.hpp"

// The double well as the system of a flow jet.

namespace hamjet::test {
namespace {

const std::string well_scene = R"(schema = 1
title = "double well"
)" + double_well_tables + R"([jet]
order = 3
duration_canonical = 3
[[integrator]]
label = "midpoint"
method = "gauss"
stages = 1
step_canonical = 0.1
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-14
[formation]
separation_m = 0.01
[generating_function]
kinds = ["F1"]
[reference]
)";

using DoubleWell = CommandTest;

// Exactness is not accuracy: the midpoint map is wrong by more than 1e-3 and as symplectic as the
// other.
TEST_F(DoubleWell, FlowJet) {
  write("well.toml", well_scene);
  succeed({"run", "well.toml", "-o", "results", "-q"});
  const Json summary = read_json(directory_ / "results/summary.json");
  EXPECT_EQ(summary["model"], "double-well");
  const Json& midpoint = summary["runs"][0];
  const Json& gauss = summary["runs"][1];
  for (const Json* run : {&midpoint, &gauss}) {
    EXPECT_TRUE((*run)["error"].is_null());
    for (const Json& row : (*run)["symplecticity_by_degree"]) EXPECT_LE(row["scaled"], 1e-13);
    for (const Json& row : (*run)["exactness"][0]["by_degree"]) EXPECT_LE(row["scaled"], 1e-12);
  }
  for (const Json& row : gauss["error_by_degree"]) EXPECT_LE(row["relative"], 1e-11);
  EXPECT_GT(midpoint["error_by_degree"][0]["relative"], 1e-3);
}

TEST_F(DoubleWell, Comparison) {
  write("well.toml", well_scene);
  succeed(
      {"compare", "well.toml", "-o", "results", "-q", "--set", "jet.order=1", "--set",
       "compare={methods=[\"gauss\"], stages=[1, 8], repeats=1, orders=[1], time_budget_s=10}"});
  const Json comparison = read_json(directory_ / "results/compare.json");
  EXPECT_GE(comparison["runs"].size(), 4U);
}

TEST_F(DoubleWell, BadInput) {
  const auto refuse = [&](const char* from, const char* to, const std::vector<std::string>& words) {
    write("bad.toml", changed(well_scene, from, to));
    expect_error({"run", "bad.toml", "-o", "bad"}, 3, words);
  };
  const char* model = "model = \"double-well\"";
  refuse(model, "model = \"double-well\"\nstiffness_N_per_m = 2",
         {"bad.toml:5:1: system.stiffness_N_per_m", "the model double-well has no key", "model"});
  refuse(model, "model = \"double-well\"\ndepth = 2", {"system.depth: unknown key"});
  refuse(model, "model = \"doublewell\"", {"system.model: unknown value", "mean double-well?"});
  refuse("position_m = [1]", "position_km = [1, 0, 0]", {"the model double-well has no key"});
  refuse("position_m = [1]", "position_m = [1, 0]",
         {"position_m: wrong length", "1 finite number"});
  refuse("separation_m = 0.01", "separation_km = 0.01", {"the model double-well has no key"});
  refuse("duration_canonical = 3", "duration_orbits = 3", {"the model double-well has no key"});
}

}  // namespace
}  // namespace hamjet::test
