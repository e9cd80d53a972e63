#include <cmath>

#include "command_test.hpp"

// Options of `hamjet run` and `hamjet demo`, and where their output goes.

namespace hamjet::test {
namespace {

using RunOptions = CommandTest;

TEST_F(RunOptions, TableComesOnStandardOutput) {
  const CommandResult result = succeed({"run", "small.toml"});
  for (const char* word :
       {"small\n", "gauss8", "midpoint", "relative error", "results: out/small"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
  // The output has neither colours nor other codes that only a terminal understands.
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(result.out.find('\r'), std::string::npos);
}

TEST_F(RunOptions, TableHoldsTimeErrorAndVerdictAndTheRestIsAskedFor) {
  const auto heading = [](const CommandResult& result) {
    const std::size_t begin = result.out.find("\nintegrator ") + 1;
    return in_one_line(result.out.substr(begin, result.out.find('\n', begin) - begin));
  };
  EXPECT_EQ(heading(succeed({"run", "small.toml"})),
            "integrator time relative error symplecticity F1 exactness verdict");
  // Without a reference the estimate takes its place, and there are no cells without a number.
  const CommandResult quick = succeed({"run", "quick.toml", "--verbose"});
  EXPECT_EQ(heading(quick), "integrator time error estimate symplecticity F1 exactness verdict");
  EXPECT_EQ(in_one_line(quick.out).find(" - "), std::string::npos) << quick.out;
  EXPECT_EQ(quick.out.find("position error"), std::string::npos) << quick.out;
  const CommandResult all = succeed({"run", "small.toml", "--verbose"});
  for (const char* word : {"steps", "rejected", "position error", "symplecticity", "energy error",
                           "error estimate", "F1 degree 0", "F2 degree 0"}) {
    EXPECT_NE(all.out.find(word), std::string::npos) << word << "\n" << all.out;
  }
  EXPECT_LE(widest_line(all.out), 80U) << all.out;
}

TEST_F(RunOptions, VerdictsOfTheTable) {
  const auto verdict = [&](const std::string& label, const std::vector<std::string>& overrides) {
    const CommandResult result = hamjet(with_overrides({"run", "quick.toml"}, overrides));
    const std::size_t begin = result.out.find("\n" + label + " ") + 1;
    const std::string line = result.out.substr(begin, result.out.find('\n', begin) - begin);
    return line.substr(line.rfind("  ") + 2);
  };
  EXPECT_EQ(verdict("gauss8", {}), "ok");
  EXPECT_EQ(verdict("gauss8", {"integrator.gauss8.require_symplecticity=1e-30"}), "check failed");
  EXPECT_EQ(verdict("midpoint", {"integrator.midpoint.require_symplecticity=1e-30"}),
            "check failed");
  // From rest the fall ends at t = pi / (2 sqrt 2) = 1.11.
  EXPECT_EQ(verdict("gauss8", {"nominal={position_km=[10000, 0, 0], velocity_km_s=[0, 0, 0]}",
                               "jet.duration_canonical=2"}),
            "failed");
  // F1 does not exist after a whole revolution; see KindThatDoesNotExistAtTheTime.
  EXPECT_EQ(
      verdict("gauss8", {"jet={order=2, duration_orbits=1}", "generating_function.kinds=[\"F1\"]"}),
      "incomplete");
}

TEST_F(RunOptions, ProgressIsShownOnATerminalAndRemoved) {
  options_.err = Stream::terminal;
  const std::vector<std::string> arguments = {"run", "quick.toml", "--set",
                                              "integrator.midpoint.step_canonical=1e-5"};
  const CommandResult result = hamjet(arguments);
  EXPECT_EQ(result.exit_code, 0);
  // The progress line has the task, its progress and the time left; at the end it is blank, with
  // the cursor at its start.
  EXPECT_NE(result.err.find("midpoint: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" %, "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" s left"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find('\n'), std::string::npos) << result.err;
  const std::string blank = "\r" + std::string(78, ' ') + "\r";
  ASSERT_GE(result.err.size(), blank.size());
  EXPECT_EQ(result.err.substr(result.err.size() - blank.size()), blank);
  EXPECT_EQ(hamjet({"run", "quick.toml", "-q"}).err, "");
}

TEST_F(RunOptions, ResultsGoToOutAndTheScenesName) {
  write("my orbit.v2.toml", quick_scene());
  succeed({"run", "my orbit.v2.toml"});
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/my_orbit.v2/summary.json"));
  EXPECT_EQ(read_json(directory_ / "out/my_orbit.v2/summary.json")["scene"], "my_orbit.v2");
}

TEST_F(RunOptions, JsonPrintsTheSummaryAlone) {
  const CommandResult result = succeed({"run", "quick.toml", "--json", "-o", "a/b/c/"});
  EXPECT_EQ(result.out, content(directory_ / "a/b/c/summary.json"));
  EXPECT_EQ(Json::parse(result.out)["scene"], "quick");
}

TEST_F(RunOptions, QuietPrintsNothing) {
  EXPECT_EQ(succeed({"run", "quick.toml", "-q"}).out, "");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/quick/summary.json"));
}

TEST_F(RunOptions, SetChangesKeysInTheirOrder) {
  succeed({"run", "--set", "jet={order=4, duration_canonical=1}", "--set", "jet.order=3",
           "quick.toml", "--set", "integrator.midpoint.step_canonical=0.05", "--set",
           "title=another", "-q"});
  const Json summary = read_json(directory_ / "out/quick/summary.json");
  EXPECT_EQ(summary["order"], 3);
  EXPECT_EQ(summary["title"], "another");
  EXPECT_EQ(summary["runs"][1]["steps"], 20);            // a duration of 1 in steps of 0.05
  EXPECT_EQ(summary["coefficients_per_component"], 84);  // C(6 + 3, 3)
}

TEST_F(RunOptions, SetToNullRemoves) {
  succeed({"run", "small.toml", "-q", "--set", "reference=null", "--set", "integrator.gauss8=null",
           "--set", "jet.duration_canonical=null", "--set", "jet.duration_orbits=0.5"});
  const Json summary = read_json(directory_ / "out/small/summary.json");
  EXPECT_TRUE(summary["reference"].is_null());
  ASSERT_EQ(summary["runs"].size(), 1U);
  EXPECT_EQ(summary["runs"][0]["label"], "midpoint");
  // Half a period of Kepler's third law, pi sqrt(a^3 / mu).
  EXPECT_NEAR(
      summary["duration_canonical"].get<double>() * summary["units"]["time_s"].get<double>(),
      std::acos(-1.0) * std::sqrt(1e12 / 398600.4415), 1e-8);
}

TEST_F(RunOptions, DemoNeedsNoFile) {
  const CommandResult result =
      succeed({"demo", "--json", "--set", "jet={order=1, duration_canonical=1}", "--set",
               "integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]"});
  const Json summary = Json::parse(result.out);
  EXPECT_EQ(summary["scene"], "earth-orbit");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/earth-orbit/gauss8/jet.csv"));
}

TEST_F(RunOptions, EnvironmentDoesNotMatter) {
  succeed({"run", "quick.toml", "-o", "plain"});
  // The second locale has a decimal comma; where it is not installed it counts as C.
  for (const char* locale : {"C.UTF-8", "de_DE.UTF-8"}) {
    options_.environment = {{"LC_ALL", locale},
                            {"HOME", std::nullopt},
                            {"TZ", std::nullopt},
                            {"TERM", std::nullopt},
                            {"NO_COLOR", "1"}};
    succeed({"run", "quick.toml", "-o", locale});
    for (const char* file : {"gauss8/jet.csv", "gauss8/nominal.csv", "midpoint/jet.csv",
                             "gauss8/generating_function_F1.csv"}) {
      EXPECT_EQ(content(directory_ / "plain" / file), content(directory_ / locale / file));
    }
  }
}

TEST_F(RunOptions, ByteOrderMarkAndCarriageReturnsAreAccepted) {
  std::string text = "\xef\xbb\xbf";
  for (const char c : quick_scene()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  write("dos.toml", text);
  succeed({"run", "quick.toml", "-o", "unix", "-q"});
  succeed({"run", "dos.toml", "-o", "dos", "-q"});
  EXPECT_EQ(content(directory_ / "unix/gauss8/jet.csv"),
            content(directory_ / "dos/gauss8/jet.csv"));
}

using Repetition = CommandTest;

TEST_F(Repetition, GivesTheSameBytes) {
  succeed({"run", "quick.toml", "-o", "results"});
  const std::string jet = content(directory_ / "results/gauss8/jet.csv");
  succeed({"run", "quick.toml", "-o", "results"});
  EXPECT_EQ(content(directory_ / "results/gauss8/jet.csv"), jet);
}

TEST_F(Repetition, ReplacesOldResultsWhole) {
  succeed({"run", "quick.toml", "-o", "results", "--set",
           "relative_hamiltonian={times_canonical=[0.5]}"});
  write("results/notes.txt", "mine");
  write("results/midpoint/notes.txt", "mine");
  // One integrator and one kind fewer, and another order: nothing of the first run may stay, or its
  // numbers would pass for those of the second.
  succeed({"run", "quick.toml", "-o", "results", "--set",
           "integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]", "--set",
           "generating_function.kinds=[\"F2\"]", "--set", "jet.order=1"});
  EXPECT_EQ(files(),
            (std::vector<std::string>{"quick.toml", "results", "results/gauss8",
                                      "results/gauss8/generating_function_F2.csv",
                                      "results/gauss8/jet.csv", "results/gauss8/nominal.csv",
                                      "results/midpoint", "results/midpoint/notes.txt",
                                      "results/notes.txt", "results/summary.json", "small.toml"}));
  // C(6 + 1, 1) = 7 monomials for each of 6 components.
  EXPECT_EQ(read_table(directory_ / "results/gauss8/jet.csv").rows.size(), 42U);
}

TEST_F(Repetition, RemovesNothingThatAForeignSummaryNames) {
  write("precious.csv", "mine");
  std::filesystem::create_directory(directory_ / "results");
  for (const char* summary :
       {R"({"runs": [{"label": "..", "exactness": [{"kind": "../../precious"}]}]})",
        R"({"runs": [{"label": "../..", "exactness": 3}, 4, null]})", R"([1, 2])", "no JSON"}) {
    write("results/summary.json", summary);
    write("jet.csv", "mine");
    succeed({"run", "quick.toml", "-o", "results", "-q"});
    EXPECT_EQ(content(directory_ / "jet.csv"), "mine");
    EXPECT_EQ(content(directory_ / "precious.csv"), "mine");
  }
}

TEST_F(Repetition, LeavesOldResultsWhereTheSecondRunFails) {
  succeed({"run", "quick.toml", "-o", "results", "-q"});
  const auto before = files();
  const std::string summary = content(directory_ / "results/summary.json");
  const std::string jet = content(directory_ / "results/gauss8/jet.csv");
  expect_error({"run", "quick.toml", "-o", "results", "--set", "jet.order=0"}, 3, {"jet.order"});
  // This is enough for the first small files, but not for the jet of order 5, as on a disk that
  // fills half-way.
  options_.largest_file = 20000;
  expect_error({"run", "quick.toml", "-o", "results", "--set", "jet.order=5"}, 5,
               {"results/gauss8/", "File too large"});
  EXPECT_EQ(files(), before);
  EXPECT_EQ(content(directory_ / "results/summary.json"), summary);
  EXPECT_EQ(content(directory_ / "results/gauss8/jet.csv"), jet);
}

}  // namespace
}  // namespace hamjet::test
