#include <cmath>

#include "evaluation/eval_command_test.hpp"

// Systems of more than one degree of freedom that are no orbits, through the command.

namespace hamjet::test {
namespace {

const std::string head = "schema = 1\ntitle = \"mechanics\"\n[system]\n";
const std::string tail = R"([[integrator]]
label = "gauss8"
method = "gauss"
tolerance = 1e-14
[reference]
)";

const std::string pair_scene = head + R"(model = "oscillator-pair"
mass_kg = 2
stiffness_N_per_m = [2, 32]
[nominal]
position_m = [1, 0.5]
momentum_kg_m_s = [0, -1]
[jet]
order = 2
duration_s = 1.5
[generating_function]
kinds = ["F1", "qp-pq", "auto"]
)" + tail;

const std::string pendulum_scene = head + R"(model = "spring-pendulum"
mass_kg = 1
stiffness_N_per_m = 100
length_m = 1
gravity_m_s2 = 10
[nominal]
position_m = [0.5, -1]
momentum_kg_m_s = [0, 0]
[jet]
order = 2
duration_s = 1
[formation]
separation_m = 0.01
[generating_function]
kinds = ["F2"]
)" + tail;

const std::string chain_scene = head + R"(model = "fermi-pasta-ulam"
omega_rad_per_s = 10
pairs = 2
[nominal]
position_m = [0.6, 0.8, 0, 0]
momentum_kg_m_s = [0, 1.4, 0, 0]
[jet]
order = 2
duration_s = 0.5
[generating_function]
kinds = ["F2"]
)" + tail;

class MechanicalModels : public EvalTest {
 protected:
  Json summary(const std::string& name) const {
    return read_json(directory_ / name / "summary.json");
  }

  void refuse(const std::string& scene, const char* from, const char* to,
              const std::vector<std::string>& words) const {
    write("bad.toml", changed(scene, from, to));
    expect_error({"check", "bad.toml"}, 3, words);
  }
};

TEST_F(MechanicalModels, RunWithNamesForEveryDegreeOfFreedom) {
  const struct {
    const char* name;
    const std::string& scene;
    std::vector<std::string> names;
  } cases[] = {{"oscillator-pair", pair_scene, {"q1", "q2", "p1", "p2"}},
               {"spring-pendulum", pendulum_scene, {"q1", "q2", "p1", "p2"}},
               {"fermi-pasta-ulam", chain_scene, {"q1", "q2", "q3", "q4", "p1", "p2", "p3", "p4"}}};
  for (const auto& one : cases) {
    SCOPED_TRACE(one.name);
    store(one.name, one.scene);
    const Json json = summary(one.name);
    EXPECT_EQ(json["model"], one.name);
    EXPECT_EQ(json["variables"], one.names);
    EXPECT_EQ(json["components"], one.names);
    EXPECT_EQ(json["units"]["length_km"], 1e-3);
    const Json& run = json["runs"][0];
    EXPECT_EQ(run["compensated_summation"], true);
    EXPECT_LE(run["energy_error"], 1e-13);
    for (const Json& row : run["error_by_degree"]) EXPECT_LE(row["relative"], 1e-11);
    for (const Json& row : run["symplecticity_by_degree"]) EXPECT_LE(row["scaled"], 1e-12);
    for (const Json& kind : run["exactness"]) {
      EXPECT_TRUE(kind["error"].is_null()) << kind["error"];
      for (const Json& row : kind["by_degree"]) EXPECT_LE(row["scaled"], 1e-11);
    }
    const std::filesystem::path folder = directory_ / one.name / "gauss8";
    EXPECT_EQ(read_table(folder / "jet.csv").header.rfind("component,e_q1,e_q2,", 0), 0U);
    const Table nominal = read_table(folder / "nominal.csv");
    EXPECT_EQ(nominal.header.rfind("time_canonical,time_s,q1,q2,", 0), 0U);
    EXPECT_EQ(nominal.rows.back().size(), one.names.size() + 3);
    EXPECT_NE(succeed({"check", std::string(one.name) + ".toml"}).out.find("for each of q1 q2"),
              std::string::npos);
  }
  const Json mixed = summary("oscillator-pair")["runs"][0]["exactness"][1];
  EXPECT_EQ(mixed["variables"], (std::vector<std::string>{"q1", "p2", "p10", "q20"}));
}

// The exact flow of the pair: frequencies 1 and 4, mass 2.
TEST_F(MechanicalModels, StoredJetsAreReadBack) {
  store("pair", pair_scene);
  const auto state = eval_one("pair", "0.5,0.25,-1,2", {"--frame", "canonical"});
  ASSERT_EQ(state.size(), 4U);
  const double t = 1.5;
  EXPECT_NEAR(state[0], 0.5 * std::cos(t) - 0.5 * std::sin(t), 1e-13);
  EXPECT_NEAR(state[1], 0.25 * std::cos(4 * t) + 0.25 * std::sin(4 * t), 1e-13);
  EXPECT_NEAR(state[2], -std::cos(t) - std::sin(t), 1e-13);
  EXPECT_NEAR(state[3], 2 * std::cos(4 * t) - 2 * std::sin(4 * t), 1e-13);
  expect_error({"eval", "pair", "--deviation", "1,1,1,1"}, 2, {"oscillator-pair is no orbit"});
  store("chain", chain_scene);
  EXPECT_EQ(eval_one("chain", "1e-3,0,0,0,0,0,0,0", {"--frame", "canonical"}).size(), 8U);
  // A chain has an even number of points, an oscillator pair two.
  write("chain/summary.json", changed(content(directory_ / "chain/summary.json"),
                                      "\"nominal_initial\": [", "\"nominal_initial\": [1.0, 2.0,"));
  expect_error({"eval", "chain", "--deviation", "1,1,1,1", "--frame", "canonical"}, 5,
               {"nominal_initial", "must have 4 or 8 or 12 or 16 numbers, has 10"});
}

// A pair that moves in one oscillator only is treated as one oscillator.
TEST_F(MechanicalModels, AnOscillatorAtRestIsLeftOut) {
  store("half",
        changed(changed(changed(pair_scene, "kinds = [\"F1\", \"qp-pq\", \"auto\"]",
                                "kinds = [\"F1\", \"auto\"]"),
                        "[1, 0.5]", "[1, 0]"),
                "[0, -1]", "[0, 0]"),
        {"--set", "jet.variables=[\"q1\", \"p1\"]", "--set", "generating_function=null"});
  EXPECT_EQ(summary("half")["components"], (std::vector<std::string>{"q1", "p1"}));
}

TEST_F(MechanicalModels, Comparison) {
  write("pendulum.toml", pendulum_scene);
  succeed({"compare", "pendulum.toml", "-o", "results", "-q", "--set", "jet.order=1", "--set",
           "compare={methods=[\"gauss\", \"velocity-verlet\"], stages=[1, 8], "
           "steps_canonical=[0.1, 0.01], "
           "repeats=1, orders=[1], time_budget_s=2}"});
  EXPECT_GE(read_json(directory_ / "results/compare.json")["runs"].size(), 4U);
}

// A method beyond its limit of stability gives no result; the other methods go on.
TEST_F(MechanicalModels, UnstableStepsAreAnError) {
  write("pair.toml", pair_scene + R"([[integrator]]
label = "verlet"
method = "velocity-verlet"
step_s = 0.75
)");
  const CommandResult result = hamjet({"run", "pair.toml", "-o", "results", "-q"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  const Json json = summary("results");
  EXPECT_TRUE(json["runs"][0]["error"].is_null());
  const std::string error = json["runs"][1]["error"];
  EXPECT_NE(error.find("unstable: omega tau = 3 exceeds 2"), std::string::npos) << error;
  EXPECT_TRUE(json["runs"][1]["nominal_final"].is_null());
}

TEST_F(MechanicalModels, BadInput) {
  refuse(pair_scene, "[2, 32]", "2", {"stiffness_N_per_m", "array of 2"});
  refuse(pair_scene, "[2, 32]", "[2, 0]", {"stiffness_N_per_m", "not positive, got 0"});
  refuse(pair_scene, "[2, 32]", "[2, 32, 1]", {"stiffness_N_per_m: wrong length"});
  refuse(pair_scene, "mass_kg = 2", "length_m = 2", {"the model oscillator-pair has no key"});
  refuse(pair_scene, "[1, 0.5]", "[1]", {"position_m: wrong length", "2 finite numbers"});
  refuse(pair_scene, "\"qp-pq\"", "\"q-p\"", {"unknown kind", "2 letters"});
  refuse(pair_scene, "[jet]\n", "[jet]\nvariables = [\"q\", \"p\"]\n",
         {"unknown variable", "q1, q2, p1, p2"});
  refuse(pendulum_scene, "length_m = 1\n", "", {"length_m: missing"});
  refuse(pendulum_scene, "length_m = 1", "length_m = 0", {"length_m: not positive"});
  refuse(pendulum_scene, "[0.5, -1]", "[0, 0]", {"at the point of suspension"});
  refuse(pendulum_scene, "[jet]", "[units]\nlength_km = 1\n[jet]",
         {"units: not available for the model spring-pendulum"});
  refuse(chain_scene, "pairs = 2", "pairs = 5", {"pairs: out of range, got 5", "1", "4"});
  refuse(chain_scene, "pairs = 2", "pairs = 1", {"position_m: wrong length", "2 finite numbers"});
  refuse(chain_scene, "pairs = 2", "pairs = 2\nmass_kg = 1",
         {"the model fermi-pasta-ulam has no key"});
  refuse(chain_scene, "omega_rad_per_s = 10", "omega_rad_per_s = -1",
         {"omega_rad_per_s: not positive"});
}

}  // namespace
}  // namespace hamjet::test
