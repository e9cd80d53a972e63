#include <filesystem>
#include <set>
#include <string>

#include "command_test.hpp"

// The command `hamjet stability` on suites of the tests' own, and on the one that is shipped.

namespace hamjet::test {
namespace {

/// cos 1 and -sin 1.
const std::string right_case = R"(schema = 1
title = "Oscillator"
[case]
group = "Oscillators"
why = "the least that there is"
outcome = "right"
source = "closed form"
state = ["0.540302305868139717400936607442976603733", "-0.841470984807896506652502321630298999623"]
)" + oscillator_tables + R"([jet]
order = 1
duration_canonical = 1
[[integrator]]
label = "gauss8"
method = "gauss"
tolerance = 1e-15
)";

class Stability : public CommandTest {
 protected:
  Stability() {
    std::filesystem::create_directory(directory_ / "suite");
    write("suite/right.toml", right_case);
  }

  void add_refused() const {
    std::string text = changed(right_case, "duration_canonical = 1", "duration_canonical = nan");
    const std::size_t expectation = text.find("outcome = ");
    text.replace(expectation, text.find("[system]") - expectation,
                 "outcome = \"refused\"\nexit_code = 3\nmessage = \"nan\"\n");
    write("suite/refused.toml", text);
  }
};

TEST_F(Stability, PrintsOneLineACaseAndWritesItsReport) {
  add_refused();
  const CommandResult result = succeed({"stability", "--suite", "suite", "-o", "out"});
  EXPECT_NE(result.out.find("right    right"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("refused  refused"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("2 cases: 1 right, 1 refused, 0 marked, none wrong."),
            std::string::npos)
      << result.out;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/stability.html"));
  EXPECT_EQ(read_table(directory_ / "out/stability.csv").rows.size(), 2U);
  EXPECT_EQ(read_json(directory_ / "out/summary.json")["cases"].size(), 2U);
}

TEST_F(Stability, JsonIsAListOfObjects) {
  add_refused();
  const Json list =
      Json::parse(succeed({"stability", "--suite", "suite", "-o", "out", "--json"}).out);
  ASSERT_TRUE(list.is_array());
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0]["case"], "refused");
  EXPECT_EQ(list[0]["outcome"], "refused");
  EXPECT_TRUE(list[0]["error"].is_null());
  EXPECT_EQ(list[1]["outcome"], "right");
  for (const char* key : {"error", "floor", "tolerance", "seconds"}) {
    EXPECT_TRUE(list[1][key].is_number()) << key;
  }
}

TEST_F(Stability, AWrongCaseIsNamedAndSetsTheExitCode) {
  write("suite/false.toml", changed(right_case, "0.5403023", "0.5403024"));
  const CommandResult result = hamjet({"stability", "--suite", "suite", "-o", "out"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "hamjet: wrong: false\n");
  EXPECT_NE(result.out.find("wrong    false"), std::string::npos) << result.out;
}

TEST_F(Stability, ASingleFileIsASuite) {
  succeed({"stability", "--suite", "suite/right.toml", "-o", "out"});
}

TEST_F(Stability, ACaseRunsAsAScene) { succeed({"run", "suite/right.toml", "-q"}); }

TEST_F(Stability, MistakesInACaseAreErrors) {
  const auto refuse = [&](const std::string& from, const std::string& to, int code,
                          const std::vector<std::string>& words) {
    write("case.toml", changed(right_case, from, to));
    expect_error({"stability", "--suite", "case.toml", "-o", "out"}, code, words);
  };
  refuse("\"right\"", "\"wright\"", 3, {"case.toml:6", "case.outcome", "right, refused, marked"});
  refuse("source = ", "sauce = ", 3, {"case.sauce", "unknown key", "did you mean source?"});
  refuse("\"right\"\n", "\"refused\"\nexit_code = 3\nmessage = \"nan\"\n", 3, {"case.source"});
  refuse("\"right\"\n", "\"marked\"\nmark = \"colour\"\n", 3, {"case.mark", "energy"});
  refuse("\"0.54030230", "\"0.54x", 3, {"case.state.0", "decimal digits"});
  refuse("[case]\n", "[casus]\n", 3, {"case"});
  std::filesystem::create_directory(directory_ / "empty");
  expect_error({"stability", "--suite", "empty", "-o", "out"}, 5, {"empty", "no case"});
  expect_error({"stability", "--suite", "absent", "-o", "out"}, 5, {"absent"});
}

// These take nearly all of the time of the suite.
const std::set<std::string> slow_cases = {"step-far-too-small",
                                          "paper-1000-revolutions",
                                          "paper-1000-revolutions-uncompensated",
                                          "near-circular-1000-revolutions",
                                          "fermi-pasta-ulam-cvode-adams",
                                          "fermi-pasta-ulam-cvode-bdf",
                                          "spring-pendulum-cvode-bdf",
                                          "oscillator-long",
                                          "order-10-against-order-2",
                                          "paper-100-revolutions"};

/// The files of the suite that is shipped, in a folder of their own: the slow cases, or the others.
/// Returns their number.
std::size_t link_cases(const std::filesystem::path& folder, bool are_slow) {
  std::filesystem::create_directory(folder);
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(HAMJET_SOURCE_DIR "/data/scenes/extreme")) {
    const auto& file = entry.path();
    const bool is_scene = file.extension() == ".toml";
    // Files that scenes name lie beside them.
    if (is_scene && slow_cases.contains(file.stem().string()) != are_slow) continue;
    std::filesystem::create_symlink(file, folder / file.filename());
    if (is_scene) ++count;
  }
  return count;
}

TEST_F(Stability, NothingIsWrongInTheShippedCasesThatAreQuick) {
  const std::size_t count = link_cases(directory_ / "quick", false);
  const CommandResult result = hamjet({"stability", "--suite", "quick", "-o", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_GE(count, 130U);
  EXPECT_EQ(read_json(directory_ / "out/summary.json")["cases"].size(), count);
}

using StabilityAtLength = Stability;

TEST_F(StabilityAtLength, NothingIsWrongInTheShippedCasesThatAreSlow) {
  options_.limit = std::chrono::seconds(900);  // sanitizers make it slow
  const std::size_t count = link_cases(directory_ / "slow", true);
  const CommandResult result = hamjet({"stability", "--suite", "slow", "-o", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_EQ(count, slow_cases.size());
  EXPECT_EQ(read_json(directory_ / "out/summary.json")["cases"].size(), count);
}

}  // namespace
}  // namespace hamjet::test
