#include <csignal>
#include <cstdlib>

#include "command_test.hpp"

// `hamjet compare` as a user runs it.

namespace hamjet::test {
namespace {

/// A few short runs on a quarter of a revolution.
constexpr const char* compare_table = R"(
[formation]
separation_km = 10
[compare]
methods = ["gauss", "fehlberg78"]
stages = [1, 4]
steps_canonical = [0.4, 0.05]
tolerances = [1e-5, 1e-9]
repeats = 2
time_budget_s = 1e6
wanted_error_m = 10
)";

class Compare : public CommandTest {
 protected:
  Compare() {
    options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()}};
    write("scene.toml", quick_scene() + (quick_scene().find("[formation]") == std::string::npos
                                             ? compare_table
                                             : without_formation()));
  }

  static std::string without_formation() {
    const std::string text = compare_table;
    return text.substr(text.find("[compare]"));
  }

  /// A comparison whose fits of orders take little time.
  static std::vector<std::string> brief(std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"compare", "scene.toml", "-q", "--set",
                                      "compare.time_budget_s=20"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  std::filesystem::path out(const std::string& file) const {
    return directory_ / "out" / "scene" / file;
  }
};

TEST_F(Compare, WritesTheSameFiguresEverywhere) {
  const CommandResult printed = hamjet({"compare", "scene.toml", "--json"});
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  const Json json = read_json(out("compare.json"));
  EXPECT_EQ(Json::parse(printed.out), json);
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["reference"]["cached"], false);
  // The runs are 2 step sizes and 2 tolerances for each of midpoint, Gauss with 4 stages, and
  // Fehlberg.
  ASSERT_EQ(json["runs"].size(), 12U);

  const Table table = read_table(out("compare.csv"));
  ASSERT_GE(table.rows.size(), json["runs"].size());
  const std::string page = content(out("report.html"));
  for (std::size_t i = 0; i < json["runs"].size(); ++i) {
    const Json& run = json["runs"][i];
    EXPECT_EQ(table.at(i, "label"), run["settings"]["label"]);
    EXPECT_EQ(table.number(i, "error_at_formation_m"), run["error_at_formation_m"].get<double>());
    EXPECT_NE(page.find(run["settings"]["label"].get<std::string>()), std::string::npos);
  }
  EXPECT_NE(page.find(json["reference"]["cached"].get<bool>() ? "taken from" : "omputed"),
            std::string::npos);
  EXPECT_TRUE(hamjet({"compare", "scene.toml", "--json", "-q"}).err.empty());
  EXPECT_EQ(read_json(out("compare.json"))["reference"]["cached"], true);
}

TEST_F(Compare, AdviceIsASceneThatReachesTheError) {
  const CommandResult result = hamjet({"compare", "scene.toml"});
  const std::size_t start = result.out.find("[[integrator]]");
  ASSERT_NE(start, std::string::npos) << result.out;
  const std::string advice = result.out.substr(start, result.out.find("\nreport:") - start);
  const std::string scene = quick_scene();
  const std::size_t first = scene.find("[[integrator]]");
  const std::size_t behind = scene.find("\n[", scene.rfind("[[integrator]]"));
  const std::string tail = behind == std::string::npos ? "" : scene.substr(behind);
  write("advised.toml", scene.substr(0, first) + advice + tail + "\n[reference]\n");
  succeed({"run", "advised.toml", "-q"});
  const Json summary = read_json(directory_ / "out/advised/summary.json");
  ASSERT_EQ(summary["runs"].size(), 1U);
  // 10 m in about 10^7 m.
  EXPECT_LT(summary["runs"][0]["error_by_degree"][0]["relative"].get<double>(), 1e-6);
}

TEST_F(Compare, WithoutGnuplotThereAreTablesAndOneLine) {
  options_.environment.emplace_back("PATH", "/nowhere");
  const CommandResult result = hamjet(brief());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("gnuplot"), std::string::npos);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  const std::string page = content(out("report.html"));
  EXPECT_EQ(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("<table"), std::string::npos);
}

TEST_F(Compare, ReferenceThatDisagreesWithItselfFails) {
  expect_error({"compare", "scene.toml", "--set", "reference={tolerance=1e-16}", "--set",
                "jet.duration_canonical=60"},
               4, {"reference: its two runs differ", "reference.tolerance"});
}

TEST_F(Compare, InterruptedAndResumedGivesTheSameFigures) {
  const auto command = [](const std::string& directory) {
    return std::vector<std::string>{"compare",
                                    "scene.toml",
                                    "-q",
                                    "-o",
                                    directory,
                                    "--set",
                                    "compare.methods=[\"gauss\"]",
                                    "--set",
                                    "compare.time_budget_s=1000"};
  };
  // The whole comparison comes first and leaves the reference in the cache, so that the runs of the
  // other begin at once.
  EXPECT_EQ(hamjet(command("whole")).exit_code, 0);
  // The first results come at once; the orders of convergence take seconds.
  options_.signal =
      Signal{SIGINT, 1, std::chrono::milliseconds(0), directory_ / "parts/compare.json"};
  const CommandResult interrupted = hamjet(command("parts"));
  options_.signal.reset();
  EXPECT_EQ(interrupted.exit_code, 130);
  EXPECT_NE(interrupted.err.find("--resume goes on"), std::string::npos) << interrupted.err;
  const Json partial = read_json(directory_ / "parts/compare.json");
  EXPECT_EQ(partial["complete"], false);
  EXPECT_GE(partial["runs"].size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "parts/report.html"));

  auto resume = command("parts");
  resume.emplace_back("--resume");
  EXPECT_EQ(hamjet(resume).exit_code, 0);
  const Json parts = read_json(directory_ / "parts/compare.json");
  const Json whole = read_json(directory_ / "whole/compare.json");
  EXPECT_EQ(parts["complete"], true);
  ASSERT_EQ(parts["runs"].size(), whole["runs"].size());
  for (std::size_t i = 0; i < whole["runs"].size(); ++i) {
    for (const char* key : {"settings", "error_by_degree", "error_at_formation_m", "exactness",
                            "energy_error", "corner"}) {
      EXPECT_EQ(parts["runs"][i][key], whole["runs"][i][key]) << i << " " << key;
    }
    EXPECT_EQ(parts["runs"][i]["seconds"].size(), 2U);
  }
  EXPECT_EQ(parts["along_time"], whole["along_time"]);
  // A comparison of other runs is kept apart from this one.
  const CommandResult other = hamjet({"compare", "scene.toml", "-q", "-o", "parts", "--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("another scene"), std::string::npos) << other.err;
}

TEST_F(Compare, ResumesACompleteComparisonWithoutChangingIt) {
  succeed(brief());
  const Json before = read_json(out("compare.json"));
  succeed(brief({"--resume"}));
  const Json after = read_json(out("compare.json"));
  EXPECT_EQ(before["runs"], after["runs"]);
  EXPECT_EQ(before["cost_runs"], after["cost_runs"]);
  EXPECT_EQ(before["along_time"], after["along_time"]);
}

TEST_F(Compare, PlotsAsFilesOnRequest) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot";
  succeed(brief({"--plots", "png"}));
  std::size_t plots = 0;
  for (const auto& file : std::filesystem::directory_iterator(out("plots"))) {
    EXPECT_EQ(content(file.path()).substr(1, 3), "PNG") << file.path();
    ++plots;
  }
  EXPECT_GE(plots, 5U);
}

TEST_F(Compare, MistakesAreNamed) {
  expect_error({"compare", "scene.toml", "--resume"}, 5, {"compare.json", "nothing to resume"});
  expect_error({"compare", "quick.toml", "--set", "formation=null"}, 3,
               {"formation", "separation_km"});
  expect_error({"compare", "scene.toml", "--plots", "gif"}, 2, {"--plots", "gif"});
  expect_error({"compare", "scene.toml", "--set", "compare.method=3"}, 3,
               {"compare.method", "did you mean methods?"});
  expect_error({"compare", "scene.toml", "--set", "compare.methods=[\"gaus\"]"}, 3,
               {"compare.methods", "gaus", "gauss, stormer"});
  expect_error({"compare", "scene.toml", "--set", "compare.stages=[0]"}, 3, {"from 1 to 12"});
  expect_error({"compare", "scene.toml", "--set", "compare.stages=[1.5]"}, 3, {"integer", "1.5"});
  expect_error({"compare", "scene.toml", "--set", "compare.tolerances=[0]"}, 3, {"tolerances"});
  expect_error({"compare", "scene.toml", "--set", "compare.steps_canonical=[-1]"}, 3, {"steps"});
  expect_error({"compare", "scene.toml", "--set", "compare.orders=[99]"}, 3, {"orders"});
  expect_error({"compare", "scene.toml", "--set", "compare.repeats=0"}, 3, {"repeats"});
  expect_error({"compare", "scene.toml", "--set", "compare.time_budget_s=0"}, 3, {"time_budget_s"});
  expect_error({"compare", "scene.toml", "--set", "compare.wanted_error_m=nan"}, 3,
               {"wanted_error_m"});
}

}  // namespace
}  // namespace hamjet::test
