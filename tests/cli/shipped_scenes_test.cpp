#include "command_test.hpp"

// Every scene that is shipped runs to the end. Order 2 in place of its own keeps the time short;
// all else is as shipped, its checks (require_...) too. Scenes of a study without a flow jet have
// no order, and run as they are. The cases of `hamjet stability` are its own test's; many are there
// to be refused.

namespace hamjet::test {
namespace {

class ShippedScenes : public CommandTest {
 protected:
  /// Everything except a file's name fits a terminal.
  static void expect_narrow(const std::string& out) {
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
      const bool is_file = line.starts_with("results: ") || line.starts_with("report: ") ||
                           line.find(".toml: the scene is good") != std::string::npos;
      EXPECT_TRUE(is_file || widest_line(line) <= 80) << line;
    }
  }

  /// A scene of a study that has no flow jet runs as it is shipped.
  void expect_study(const std::vector<std::string>& arguments, int count) const {
    expect_narrow(succeed(arguments).out);
    const Json summary = read_json(directory_ / std::to_string(count) / "summary.json");
    EXPECT_EQ(summary["exit_code"], 0);
    EXPECT_TRUE(summary["study"].is_string());
  }
};

TEST_F(ShippedScenes, RunToTheEnd) {
  options_.limit = std::chrono::seconds(300);  // sanitizers make it slow
  const std::filesystem::path scenes = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes";
  const std::string integrators = succeed({"list", "integrators"}).out;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string scene = entry.path().string();
    SCOPED_TRACE(scene);
    if (content(scene).find("\n[case]\n") != std::string::npos) continue;
    if (content(scene).find("\n[sweep]\n") != std::string::npos) continue;  // a study, below
    std::vector<std::string> arguments = {"run", scene, "-o", std::to_string(++count), "--verbose"};
    if (content(scene).find("\nstudy = ") != std::string::npos) {
      expect_study(arguments, count);
      continue;
    }
    arguments.insert(arguments.end(), {"--set", "jet.order=2"});
    // Of which a run says on standard error that they are not its own.
    if (content(scene).find("\ncoordinates = ") != std::string::npos) {
      arguments.insert(arguments.end(), {"--set", "jet.coordinates=null"});
    }
    for (const std::string& label : labels_not_built(integrators, content(scene))) {
      arguments.emplace_back("--set");
      arguments.push_back("integrator." + label + "=null");
    }
    const std::string table = succeed(arguments).out;
    expect_narrow(table);
    EXPECT_EQ(table.find(" -\n"), std::string::npos) << table;
    expect_narrow(succeed({"check", scene}).out);
    const Json summary = read_json(directory_ / std::to_string(count) / "summary.json");
    EXPECT_EQ(summary["order"], 2);
    EXPECT_GE(summary["runs"].size(), 1U);
    for (const Json& run : summary["runs"]) {
      EXPECT_TRUE(run["error"].is_null()) << run["label"] << run["error"];
      EXPECT_EQ(run["nominal_final"].size(), summary["nominal_initial"].size());
    }
  }
  EXPECT_GE(count, 17);
}

// Every shipped study can be read, and its scenes can be computed.
TEST_F(ShippedScenes, StudiesAreGood) {
  const std::filesystem::path studies =
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/sweeps";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(studies)) {
    if (content(entry.path()).find("\n[sweep]\n") == std::string::npos) continue;
    const std::string directory = std::to_string(++count);
    // One item in a thousand, without its table.
    succeed({"sweep", entry.path().string(), "-o", directory, "-q", "--shard", "500/1000"});
    EXPECT_TRUE(std::filesystem::exists(directory_ / directory / "rows"));
  }
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace hamjet::test
