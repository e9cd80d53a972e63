#include <csignal>

#include "command_test.hpp"

// Signals. 128 + the signal's number is what shells report: 129 for SIGHUP, 130 for SIGINT, 131 for
// SIGQUIT, 143 for SIGTERM.

namespace hamjet::test {
namespace {

class Interruption : public CommandTest {
 protected:
  /// The command must have ended long before the scene could have been computed, leaving nothing.
  void expect_interrupted(const std::vector<std::string>& arguments, Signal signal) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const auto before = files();
    options_.signal = signal;
    options_.limit = std::chrono::seconds(20);
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.exit_code, 128 + signal.number);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "hamjet: interrupted; nothing was written\n");
    EXPECT_EQ(files(), before);
  }
};

// 100 million steps, each short: the command stops between two.
const std::vector<std::string> many_steps = {"run", "quick.toml", "--set",
                                             "integrator.midpoint.step_canonical=1e-8"};
// A reference of order 11, in which a single step takes the better part of a minute.
const std::vector<std::string> long_steps = {"run", "small.toml", "--set", "jet.order=11"};

TEST_F(Interruption, BetweenSteps) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    expect_interrupted(many_steps, {signal});
  }
}

// A command that is started by nohup outlives its terminal.
TEST_F(Interruption, AHangUpThatIsIgnoredStaysSo) {
  for (const int signal : {SIGHUP, SIGQUIT}) {
    options_.signal = Signal{.number = signal,
                             .times = 20,
                             .after = std::chrono::milliseconds(10),
                             .path = {},
                             .is_ignored = true};
    succeed({"run", "quick.toml", "-q"});
  }
}

TEST_F(Interruption, WithinAStep) {
  expect_interrupted(long_steps, {SIGINT});
  expect_interrupted(long_steps, {SIGTERM});
}

TEST_F(Interruption, Twice) { expect_interrupted(long_steps, {SIGINT, 2}); }

TEST_F(Interruption, LeavesEarlierResultsAlone) {
  succeed({"run", "quick.toml", "-q"});
  const std::string jet = content(directory_ / "out/quick/gauss8/jet.csv");
  expect_interrupted(many_steps, {SIGTERM});
  EXPECT_EQ(content(directory_ / "out/quick/gauss8/jet.csv"), jet);
}

TEST_F(Interruption, KilledItLeavesNothingThatIsSeenOrInTheWay) {
  options_.limit = std::chrono::seconds(1);
  EXPECT_TRUE(run_command(many_steps, options_).is_timed_out);
  EXPECT_EQ(files(), (std::vector<std::string>{"out", "out/quick", "out/quick/.hamjet-lock",
                                               "quick.toml", "small.toml"}));
  options_.limit = std::chrono::seconds(120);
  succeed({"run", "quick.toml", "-q"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out/quick/.hamjet-lock"));
}

TEST_F(Interruption, BetweenFiguresAndReportTheFiguresStay) {
  const std::filesystem::path summary = directory_ / "out/quick/compare.json";
  const std::vector<std::string> command = {
      "compare", "quick.toml", "--set",
      "compare={methods=[\"gauss\"], stages=[1], tolerances=[1e-3], orders=[1], repeats=1, "
      "time_budget_s=20}"};
  options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()}};
  options_.signal = Signal{SIGINT, 1, std::chrono::milliseconds(0), summary};
  const CommandResult result = hamjet(command);
  EXPECT_EQ(result.exit_code, 130);
  // On a slow machine the first figures are there before the last.
  const bool is_complete = read_json(summary)["complete"];
  EXPECT_EQ(result.err, is_complete
                            ? "hamjet: interrupted; all figures are in out/quick, without "
                              "the report, which the same command with --resume makes\n"
                            : "hamjet: interrupted; what was finished is in out/quick, "
                              "marked as partial; the same command with --resume goes on\n");
  options_.signal.reset();
  std::vector<std::string> resumed = command;
  resumed.emplace_back("--resume");
  succeed(resumed);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/quick/report.html"));
}

// Each command would take minutes. The signals come at times that range from its very start to a
// second in which it is deep at work.
TEST_F(Interruption, AtAnyMomentOfAnyCommand) {
  const std::string transfer =
      "transfer={frame=\"RTN\", count=10000, start={position_m=[0, -1000, 0]}, "
      "end={position_m=[0, -100, 0]}}";
  const std::vector<std::string> commands[] = {
      many_steps,
      {"compare", "quick.toml", "--set",
       "compare={methods=[\"gauss\"], stages=[1], steps_canonical=[0.4, 1e-8], "
       "tolerances=[1e-5], orders=[1], repeats=1, time_budget_s=1e6}"},
      {"transfer", "quick.toml", "--set", transfer, "--set", "jet.order=8"},
      {"validity", "quick.toml", "--set", "validity={count=1000, samples=1000}", "--set",
       "jet.order=8"},
      {"run", std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/energy-midpoint-kepler.toml",
       "--set", "energy_conservation.duration_orbits=8000"},
  };
  options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()}};
  options_.limit = std::chrono::seconds(20);
  const auto before = files();
  int number = 0;
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(::testing::PrintToString(command));
    for (const int milliseconds : {0, 3, 10, 30, 100, 300}) {
      const int signal = ++number % 2 == 0 ? SIGINT : SIGTERM;
      const int times = number % 3 == 0 ? 2 : 1;
      options_.signal = Signal{signal, times, std::chrono::milliseconds(milliseconds)};
      const CommandResult result = hamjet(command);
      EXPECT_EQ(result.exit_code, 128 + signal) << milliseconds << " ms: " << result.err;
      EXPECT_EQ(result.out, "");
      EXPECT_EQ(result.err.rfind("hamjet: interrupted", 0), 0U) << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      std::filesystem::remove_all(directory_ / "cache");
      if (result.err.find("nothing was written") == std::string::npos) {
        // A comparison keeps its results so far as a set of its own, or nothing if a second signal
        // came while the set was written.
        EXPECT_EQ(command[0], "compare");
        const std::filesystem::path summary = directory_ / "out/quick/compare.json";
        if (result.err.find("while the results were written") == std::string::npos) {
          EXPECT_EQ(files(), (std::vector<std::string>{"out", "out/quick", "out/quick/compare.csv",
                                                       "out/quick/compare.json", "quick.toml",
                                                       "small.toml"}));
        }
        if (std::filesystem::exists(summary)) {
          EXPECT_EQ(read_json(summary)["complete"], false);
          EXPECT_EQ(read_json(summary)["files"].size(), 1U);
        }
        std::filesystem::remove_all(directory_ / "out");
      }
      EXPECT_EQ(files(), before) << milliseconds;
    }
  }
}

}  // namespace
}  // namespace hamjet::test
