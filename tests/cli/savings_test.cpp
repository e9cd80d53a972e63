#include <algorithm>

#include "command_test.hpp"

// Work that a scene does not need is not done. For every saving the test compares its counter in
// summary.json with and without the saving, and its entry in the list of skipped work.

namespace hamjet::test {
namespace {

const std::string oblate_scene = R"(schema = 1
title = "oblate"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378
J2 = 1e-3
J3 = -2.5e-6
)" + orbit_elements + R"([jet]
order = 3
duration_canonical = 1
[[integrator]]
label = "a"
method = "gauss"
stages = 4
step_canonical = 0.1
)";

class Savings : public CommandTest {
 protected:
  Savings() { write("scene.toml", oblate_scene); }

  Json run(const std::vector<std::string>& overrides, const std::string& scene = "scene.toml") {
    succeed(with_overrides({"run", scene, "-q", "-o", "results"}, overrides));
    return read_json(directory_ / "results/summary.json");
  }

  static bool skips(const Json& summary, const std::string& what) {
    const Json& list = summary["skipped"];
    return std::any_of(list.begin(), list.end(), [&](const Json& entry) {
      EXPECT_FALSE(entry["why"].get<std::string>().empty());
      return entry["what"] == what;
    });
  }
  static double count(const Json& summary, const std::string& key) {
    return summary["runs"][0]["operations"][key].get<double>();
  }

  /// The first run does not do the work that only the second needs, and says so.
  static void expect_saving(const Json& without, const Json& with, const std::string& what,
                            const std::vector<std::string>& counters) {
    EXPECT_TRUE(skips(without, what)) << what << without["skipped"];
    EXPECT_FALSE(skips(with, what)) << what << with["skipped"];
    for (const std::string& key : counters) {
      EXPECT_LT(count(without, key), count(with, key)) << what << " " << key;
    }
  }
};

TEST_F(Savings, ForceTerms) {
  const std::vector<std::string> counters = {
      "operations_per_evaluation", "nonlinear_operations_per_evaluation",
      "multiply_adds_per_evaluation", "slice_products", "multiply_adds"};
  const Json whole = run({});
  const Json without_J3 = run({"system.J3=null"});
  expect_saving(without_J3, whole, "J3", counters);
  // J3 needs all that J2 does: only without both there are fewer operations.
  expect_saving(run({"system.J2=null", "system.J3=null"}), without_J3, "J2", counters);
  EXPECT_TRUE(skips(run({"system.J2=null"}), "J2"));
  // Above the highest coefficient that is present nothing is done, and each further one that is
  // present costs more.
  EXPECT_TRUE(skips(whole, "J4 to J20"));
  const Json with_J6 = run({"system.J4=-1.6e-6", "system.J5=-2.3e-7", "system.J6=5.4e-7"});
  EXPECT_TRUE(skips(with_J6, "J7 to J20"));
  expect_saving(run({"system.J4=-1.6e-6", "system.J6=5.4e-7"}), with_J6, "J5", {});
  expect_saving(run({"system.J4=-1.6e-6", "system.J5=-2.3e-7"}), with_J6, "J6 to J20", counters);
  // A coefficient of zero counts as absent.
  EXPECT_EQ(run({"system.J3=0"})["runs"][0]["operations"],
            run({"system.J3=null"})["runs"][0]["operations"]);
}

TEST_F(Savings, DegreesOfFreedomThatStayZero) {
  const std::string equatorial = "nominal.i_deg=0";
  const std::string plane = "jet.variables=[\"x\", \"y\", \"px\", \"py\"]";
  // With J3 the plane is left, though not expanded out of.
  const Json without = run({equatorial, plane, "system.J3=null"});
  const Json with = run({equatorial, "system.J3=null"});
  expect_saving(without, with, "components z, pz",
                {"operations_per_evaluation", "multiply_adds", "poisson_brackets"});
  EXPECT_FALSE(skips(run({equatorial, plane}), "components z, pz"));
}

TEST_F(Savings, VariablesNotExpandedIn) {
  const Json without = run({"jet.variables=[\"x\", \"y\", \"z\"]"});
  const Json with = run({});
  expect_saving(without, with, "variables px, py, pz",
                {"multiply_adds_per_evaluation", "multiply_adds", "poisson_brackets"});
  EXPECT_TRUE(skips(without, "Poisson brackets"));
  EXPECT_EQ(count(without, "poisson_brackets"), 0);
  EXPECT_EQ(count(with, "poisson_brackets"), 15);  // pairs of six components
}

TEST_F(Savings, DegreesOfALinearSystem) {
  write("spring.toml", R"(schema = 1
title = "spring"
)" + oscillator_tables + R"([jet]
order = 4
duration_canonical = 1
[[integrator]]
label = "a"
method = "gauss"
tolerance = 1e-12
)");
  const Json linear = run({}, "spring.toml");
  EXPECT_TRUE(skips(linear, "degrees 2 to 4"));
  EXPECT_EQ(count(linear, "slice_products"), 0);
  EXPECT_EQ(count(linear, "nonlinear_operations_per_evaluation"), 0);
  EXPECT_FALSE(skips(run({"jet.order=1"}, "spring.toml"), "degrees 2 to 4"));
  const Json nonlinear = run({"system={model=\"double-well\"}"}, "spring.toml");
  EXPECT_FALSE(skips(nonlinear, "degrees 2 to 4"));
  EXPECT_GT(count(nonlinear, "slice_products"), 0);
  // Order 1 forms no products of any system.
  EXPECT_EQ(count(run({"jet.order=1"}), "slice_products"), 0);
}

TEST_F(Savings, PartsOfTheScene) {
  const Json without = run({"jet.order=1"});
  const Json with =
      run({"jet.order=1", "reference={}", "generating_function={kinds=[\"F1\", \"F2\"]}",
           "figure={quantity=\"energy-error\"}", "relative_hamiltonian={times_canonical=[0, 1]}"});
  for (const char* what : {"reference", "generating functions", "figure", "relative Hamiltonian"}) {
    expect_saving(without, with, what, {});
  }
  const std::vector<std::pair<const char*, int>> counters = {
      {"reference_runs", 2},        // two of different step size, to know the uncertainty
      {"inversions", 2},            // one for each kind
      {"floor_inversions", 2},      // steps of the reference's map, one for each kind
      {"compositions", 2},          // self-check, one for each kind
      {"exactness_residuals", 2},   //
      {"figures", 1},               //
      {"relative_hamiltonians", 2}  // times
  };
  for (const auto& [key, expected] : counters) {
    EXPECT_EQ(without["operations"][key], 0) << key;
    EXPECT_EQ(with["operations"][key], expected) << key;
  }
  EXPECT_EQ(count(without, "points_watched_for_figure"), 0);
  EXPECT_EQ(count(with, "points_watched_for_figure"), 10);  // one in each step
  EXPECT_GT(with["operations"]["reference_evaluations"], 0);
  EXPECT_EQ(without["operations"]["reference_evaluations"], 0);
}

TEST_F(Savings, SelfChecks) {
  const Json with = run({"generating_function={kinds=[\"F1\"]}"});
  EXPECT_EQ(count(with, "self_checks"), 8);
  for (const Json& entry : with["runs"][0]["checks"]) {
    const std::string name = entry["name"];
    const Json without = run({"generating_function={kinds=[\"F1\"]}", "checks." + name + "=false"});
    expect_saving(without, with, "check " + name, {"self_checks"});
    EXPECT_EQ(count(without, "self_checks"), 7);
    for (const Json& check : without["runs"][0]["checks"]) {
      if (check["name"] == name) {
        EXPECT_EQ(check["seconds"], 0) << name;
      }
    }
    if (name == "inversion") {
      EXPECT_EQ(count(without, "compositions"), 0);
    }
  }
}

TEST_F(Savings, CountsAreThoseOfTheEvaluations) {
  // Counted in the evaluator, and predicted from the list of operations.
  const Json summary = run({});
  EXPECT_EQ(count(summary, "evaluations"), 40);  // ten steps of four stages
  EXPECT_EQ(count(summary, "multiply_adds"), 40 * count(summary, "multiply_adds_per_evaluation"));
  for (const char* method : {"velocity-verlet", "fehlberg78", "newmark"}) {
    const Json other = run({std::string("integrator=[{label=\"a\", method=\"") + method +
                            "\", step_canonical=0.05}]"});
    EXPECT_EQ(count(other, "multiply_adds"),
              count(other, "evaluations") * count(other, "multiply_adds_per_evaluation"))
        << method;
  }
}

}  // namespace
}  // namespace hamjet::test
