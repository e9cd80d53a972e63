#include <algorithm>
#include <csignal>

#include "command_test.hpp"

// Jets of one long arc in pieces, on threads: `jet.arcs` and `hamjet run --threads`.

namespace hamjet::test {
namespace {

const std::string long_scene = R"(schema = 1
title = "five revolutions"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378
J2 = 1e-3
)" + orbit_elements + R"([jet]
order = 4
duration_orbits = 5
[[integrator]]
label = "gauss8"
method = "gauss"
tolerance = 1e-12
require_symplecticity = 1e-13
)";

class Arcs : public CommandTest {
 protected:
  Arcs() { write("scene.toml", long_scene); }

  /// The files of a run: jet, nominal, summary.
  struct Files {
    std::string jet;
    std::string nominal;
    Json run;
  };
  Files run(std::vector<std::string> more, const std::string& label = "gauss8") {
    more.insert(more.begin(), {"run", "scene.toml", "-q", "-o", "results"});
    succeed(more);
    const auto folder = directory_ / "results" / label;
    return {content(folder / "jet.csv"), content(folder / "nominal.csv"),
            read_json(directory_ / "results/summary.json")["runs"][0]};
  }
};

TEST_F(Arcs, GiveTheSameBytesOnAnyNumberOfThreads) {
  for (const char* arcs : {"jet.arcs=auto", "jet.arcs=5"}) {
    const Files one = run({"--set", arcs, "--threads", "1"});
    EXPECT_GT(one.run["arcs"]["count"], 1);
    EXPECT_EQ(one.run["arcs"]["threads"], 1);
    for (const char* threads : {"2", "4"}) {
      const Files other = run({"--set", arcs, "--threads", threads});
      EXPECT_EQ(other.jet, one.jet) << arcs << " " << threads;
      EXPECT_EQ(other.nominal, one.nominal) << arcs << " " << threads;
      EXPECT_EQ(other.run["arcs"]["threads"],
                std::min(std::stoi(threads), one.run["arcs"]["count"].get<int>()));
      EXPECT_EQ(other.run["operations"], one.run["operations"]);
    }
    const Files by_default = run({"--set", arcs});
    EXPECT_EQ(by_default.jet, one.jet);
  }
}

TEST_F(Arcs, LeaveTheNominalAndOneArcAsTheyAre) {
  const Files whole = run({});
  EXPECT_FALSE(whole.run.contains("arcs"));
  const Files one = run({"--set", "jet.arcs=1", "--threads", "2"});
  EXPECT_EQ(one.jet, whole.jet);
  EXPECT_FALSE(one.run.contains("arcs"));
  const Files three = run({"--set", "jet.arcs=3"});
  EXPECT_EQ(three.nominal, whole.nominal);
  EXPECT_NE(three.jet, whole.jet);
  for (const char* key : {"steps", "rejected_steps", "nominal_final", "energy_error"}) {
    EXPECT_EQ(three.run[key], whole.run[key]) << key;
  }
  // The same checks, and all of them passed.
  ASSERT_EQ(three.run["checks"].size(), whole.run["checks"].size());
  for (std::size_t i = 0; i < three.run["checks"].size(); ++i) {
    EXPECT_EQ(three.run["checks"][i]["name"], whole.run["checks"][i]["name"]);
    EXPECT_EQ(three.run["checks"][i]["state"], whole.run["checks"][i]["state"]);
  }
}

TEST_F(Arcs, AreCounted) {
  // Arcs use every symmetry.
  const Json whole = run({"--set", "jet.symmetry=\"none\""}).run["operations"];
  const Files three = run({"--set", "jet.arcs=3", "--threads", "2"});
  EXPECT_EQ(three.run["arcs"]["compositions"], 2);
  EXPECT_EQ(three.run["operations"]["compositions"], 2 + whole["compositions"].get<int>());
  // Every step of the jet is taken once. The stages of the nominal are found once and evaluated
  // once more in the arcs.
  EXPECT_EQ(three.run["operations"]["evaluations"], whole["evaluations"]);
  EXPECT_EQ(three.run["operations"]["multiply_adds"], whole["multiply_adds"]);
  EXPECT_EQ(three.run["operations"]["nominal_evaluations"],
            whole["nominal_evaluations"].get<long>() + three.run["steps"].get<long>());
}

TEST_F(Arcs, AreDecidedAndShown) {
  const std::string checked = succeed({"check", "scene.toml", "--set", "jet.arcs=auto"}).out;
  EXPECT_NE(checked.find("  arcs         gauss8: "), std::string::npos) << checked;
  EXPECT_NE(checked.find(" arcs (auto: composing takes "), std::string::npos) << checked;
  const std::string table =
      succeed({"run", "scene.toml", "--threads", "2", "--set", "jet.arcs=auto"}).out;
  EXPECT_NE(table.find("; ran on 2 threads\n"), std::string::npos) << table;
  // The decision is the same in both, with the speed-ups estimated for 1, 2 and 4 threads.
  const auto decision = [](const std::string& wrapped) {
    const std::string text = unwrapped(wrapped);
    const std::size_t first = text.find("gauss8: ", text.find("arcs (") - 20);
    return text.substr(first, text.find(" threads", first) - first);
  };
  EXPECT_EQ(decision(table), decision(checked));
  EXPECT_NE(decision(table).find(" on 1, "), std::string::npos) << table;
  const Json arcs = run({"--set", "jet.arcs=auto"}).run["arcs"];
  EXPECT_EQ(arcs["asked"], "auto");
  // The run is split, because splitting is expected to pay on four threads.
  EXPECT_GE(arcs["estimated_speed_up_by_threads"]["4"], 1.5);
  EXPECT_GT(arcs["multiply_adds"]["composition"], 0);
  // Splitting does not pay here.
  const Json low = run({"--set", "jet.arcs=auto", "--set", "jet.order=1"}).run["arcs"];
  EXPECT_EQ(low["count"], 1);
  EXPECT_EQ(low["reason"], "splitting would not pay on 4 threads");
}

TEST_F(Arcs, AreRefusedWhereTheyAreNotPossible) {
  expect_error({"run", "scene.toml", "--set", "jet.arcs=2", "--set",
                "integrator.gauss8.method=\"fehlberg78\"", "--set",
                "integrator.gauss8.require_symplecticity=null"},
               3, {"jet.arcs", "the integrator gauss8", "fehlberg78 is not available in arcs"});
  write("figure.toml", long_scene + "[figure]\nquantity = \"exactness\"\n");
  expect_error({"run", "figure.toml", "--set", "jet.arcs=2"}, 3,
               {"jet.arcs", "the figure takes the jet after every step"});
  // A run that auto cannot split stays whole, and the reason is printed.
  const Json left =
      run({"--set", "jet.arcs=auto", "--set", "integrator.gauss8.method=\"fehlberg78\"", "--set",
           "integrator.gauss8.require_symplecticity=null"})
          .run["arcs"];
  EXPECT_EQ(left["count"], 1);
  EXPECT_EQ(left["reason"], "fehlberg78 is not available in arcs");
  for (const char* value : {"0", "1001", "-1", "2.0", "\"many\"", "true"}) {
    expect_error({"check", "scene.toml", "--set", std::string("jet.arcs=") + value}, 3,
                 {"jet.arcs", "must be \"auto\" or an integer from 1 to 1000"});
  }
  for (const char* threads : {"0", "-1", "x", "2000"}) {
    expect_error({"run", "scene.toml", "--threads", threads}, 2, {"--threads"});
  }
  expect_error({"compare", "scene.toml", "--set", "jet.arcs=auto"}, 3,
               {"scene.toml: jet.arcs: hamjet compare", "must be 1"});
  expect_error({"validity", "scene.toml", "--set", "jet.arcs=2"}, 3, {"hamjet validity"});
}

TEST_F(Arcs, AreInterrupted) {
  options_.signal = Signal{SIGINT};
  options_.limit = std::chrono::seconds(20);
  const CommandResult result = hamjet({"run", "scene.toml", "--threads", "2", "--set", "jet.arcs=2",
                                       "--set", "jet.order=9", "--set", "jet.duration_orbits=500"});
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(result.err, "hamjet: interrupted; nothing was written\n");
}

TEST_F(Arcs, FailAsTheUnsplitRunDoes) {
  write("fall.toml", changed(long_scene, "e = 0.1", "e = 0.999999"));
  const std::vector<std::string> fall = {"run",
                                         "fall.toml",
                                         "-q",
                                         "--set",
                                         "integrator.gauss8.stages=2",
                                         "--set",
                                         "integrator.gauss8.step_s=300",
                                         "--set",
                                         "integrator.gauss8.tolerance=null"};
  const auto failure = [&](const std::string& arcs) {
    std::vector<std::string> arguments = fall;
    arguments.insert(arguments.end(), {"--set", arcs, "-o", "fall"});
    EXPECT_EQ(hamjet(arguments).exit_code, 4);
    return read_json(directory_ / "fall/summary.json")["runs"][0]["error"];
  };
  const Json whole = failure("jet.arcs=1");
  EXPECT_TRUE(whole.is_string());
  EXPECT_EQ(failure("jet.arcs=2"), whole);
}

}  // namespace
}  // namespace hamjet::test
