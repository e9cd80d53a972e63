#include <csignal>

#include "command_test.hpp"

// Signals. 128 + the signal's number is what shells report: 130 for SIGINT, 143 for SIGTERM.

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
  expect_interrupted(many_steps, {SIGINT});
  expect_interrupted(many_steps, {SIGTERM});
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

}  // namespace
}  // namespace hamjet::test
