#include <fcntl.h>

#include "command_test.hpp"

// A scene from standard input, and what is not written to standard output.

namespace hamjet::test {
namespace {

/// The test's own standard input, which the command inherits, is this file while it lives.
class InputFrom {
 public:
  explicit InputFrom(const std::filesystem::path& file) : before_(::dup(STDIN_FILENO)) {
    const int input = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_GE(input, 0) << file;
    ::dup2(input, STDIN_FILENO);
    ::close(input);
  }
  ~InputFrom() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  InputFrom(const InputFrom&) = delete;
  InputFrom& operator=(const InputFrom&) = delete;

 private:
  int before_;
};

class StandardInput : public CommandTest {
 protected:
  /// Runs the command with this text on its standard input.
  CommandResult with_input(const std::string& text,
                           const std::vector<std::string>& arguments) const {
    const InputFrom input(write("input", text));
    return hamjet(arguments);
  }
};

TEST_F(StandardInput, HoldsAScene) {
  succeed({"run", "quick.toml", "-q"});
  const CommandResult run = with_input(quick_scene(), {"run", "-"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\nresults: out/standard-input\n"), std::string::npos) << run.out;
  EXPECT_EQ(content(directory_ / "out/standard-input/midpoint/jet.csv"),
            content(directory_ / "out/quick/midpoint/jet.csv"));
  const CommandResult check = with_input(quick_scene(), {"check", "--", "-"});
  EXPECT_EQ(check.out.rfind("<standard input>: the scene is good\n", 0), 0U) << check.out;
  EXPECT_EQ(with_input(quick_scene(), {"run", "-", "-q", "-o", "mine"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "mine/summary.json"));
}

TEST_F(StandardInput, MistakesAreNamed) {
  const std::string wrong = changed(quick_scene(), "order = 2", "order = 0");
  CommandResult result = with_input(wrong, {"run", "-"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err.rfind("hamjet: <standard input>:14:9: jet.order: ", 0), 0U) << result.err;
  // A message about a missing table uses this name too.
  result = with_input(quick_scene(), {"transfer", "-"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err.rfind("hamjet: <standard input>: transfer: missing", 0), 0U) << result.err;
  result = with_input(std::string(2 << 20, '#'), {"check", "-"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("<standard input>: the scene is too large"), std::string::npos);
  // A folder in place of a file or a pipe.
  {
    const InputFrom input(directory_);
    result = hamjet({"check", "-"});
  }
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_NE(result.err.find("standard input cannot be read: Is a directory"), std::string::npos);
  options_.has_input = false;
  EXPECT_EQ(hamjet({"check", "-"}).exit_code, 3);
}

// Standard input is read once, although a scene of one stored jet is read twice (because it need
// not say a time).
TEST_F(StandardInput, IsReadOnce) {
  succeed({"run", "quick.toml", "-q"});
  const std::string timeless = quick_scene() +
                               "[transfer]\nframe = \"RTN\"\nstart = {position_m = [0, -10, 0]}\n"
                               "end = {position_m = [0, -5, 0]}\n";
  const CommandResult result =
      with_input(timeless, {"transfer", "-", "--jet", "out/quick", "-q", "-o", "answer"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "answer/transfers.csv"));
}

// A scene in place of results, and the deputy of the same text.
TEST_F(StandardInput, HoldsASceneThatIsEvaluated) {
  const std::string scene = short_kepler_scene("near") + "[deputy]\nposition_m = [3, -10, 2]\n";
  write("near.toml", scene);
  const std::string row = succeed({"eval", "near.toml", "--deputy", "near.toml", "-q"}).out;
  for (const char* const deputy : {"near.toml", "-"}) {
    const CommandResult result = with_input(scene, {"eval", "-", "--deputy", deputy, "-q"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, row);
  }
  const CommandResult wrong =
      with_input(changed(scene, "position_m", "position"), {"eval", "-", "--deputy", "-"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_EQ(wrong.err.rfind("hamjet: <standard input>:", 0), 0U) << wrong.err;
}

TEST_F(StandardInput, IsNoStudyOfASweep) {
  expect_error({"sweep", "-"}, 2, {"study: got -", "must be a file"});
}

TEST_F(StandardInput, OutputHasAName) {
  for (const char* command : {"run", "compare", "transfer", "validity", "assign", "sweep"}) {
    expect_error({command, "quick.toml", "-o", "-"}, 2,
                 {"--output: got -", "--json prints their summary", "./- is what has that name"});
  }
  expect_error({"demo", "--output=-"}, 2, {"--output: got -"});
  expect_error({"stability", "-o-"}, 2, {"--output: got -"});
  expect_error({"eval", "out/quick", "--deviation", "0,0,0,0,0,0", "-o", "-"}, 2,
               {"--output: got -", "standard output is what it is without -o"});
  succeed({"run", "quick.toml", "-q", "-o", "./-"});
  EXPECT_TRUE(std::filesystem::exists(directory_ / "-/summary.json"));
}

}  // namespace
}  // namespace hamjet::test
