#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command_test.hpp"

namespace hamjet::test {

/// One directory that receives two different results in turns: whatever happens, it must hold the
/// one or the other, whole, and a later hamjet must read them.
class TwoResults : public CommandTest {
 protected:
  static constexpr const char* results = "results";

  /// Two scenes in turns, so that old and new results differ in every file and in their number.
  static std::vector<std::string> command(int which, const std::string& directory) {
    std::vector<std::string> arguments = {"run", "quick.toml", "-q", "-o", directory};
    if (which == 1) {
      arguments.insert(arguments.end(),
                       {"--set", "jet.order=3", "--set", "integrator.midpoint.label=other", "--set",
                        "generating_function.kinds=[\"F1\"]"});
    }
    return arguments;
  }

  std::string evaluate(const std::string& directory) const {
    const CommandResult result =
        hamjet({"eval", directory, "-q", "--deviation", "100,200,300,0.1,0.2,0.3"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }

  /// Determines which of the two results is in the directory; the result must be whole, without
  /// parts of the other.
  int found() const {
    const std::string text = evaluate(results);
    const int which = text == evaluated_[0] ? 0 : 1;
    EXPECT_EQ(text, evaluated_[which]);
    const std::filesystem::path whole = directory_ / fmt::format("whole{}", which);
    std::vector<std::string> expected;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(whole)) {
      const std::filesystem::path name = entry.path().lexically_relative(whole);
      expected.push_back(name.string());
      // The summary contains times.
      if (entry.is_directory() || name == "summary.json") continue;
      EXPECT_EQ(content(directory_ / results / name), content(entry.path())) << name;
    }
    std::vector<std::string> names;
    for (auto entry = std::filesystem::recursive_directory_iterator(directory_ / results);
         entry != std::filesystem::recursive_directory_iterator(); ++entry) {
      const std::string name = entry->path().lexically_relative(directory_ / results).string();
      // A killed process may have left its hidden file and folder.
      if (name.starts_with(".hamjet-")) {
        entry.disable_recursion_pending();
      } else {
        names.push_back(name);
      }
    }
    std::sort(names.begin(), names.end());
    std::sort(expected.begin(), expected.end());
    // Folders for new files may have been made before the decision.
    std::erase_if(names, [&](const std::string& name) {
      return std::filesystem::is_directory(directory_ / results / name) &&
             std::filesystem::is_empty(directory_ / results / name);
    });
    EXPECT_EQ(names, expected);
    return which;
  }

  /// Makes both results elsewhere, and puts the first of them into the directory.
  void make_results() {
    for (const int which : {0, 1}) {
      const std::string directory = fmt::format("whole{}", which);
      succeed(command(which, directory));
      evaluated_[which] = evaluate(directory);
    }
    ASSERT_NE(evaluated_[0], evaluated_[1]);
    succeed(command(0, results));
  }

 private:
  std::string evaluated_[2];
};

}  // namespace hamjet::test
