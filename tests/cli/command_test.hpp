#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "command.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "support/temporary_directory.hpp"
#include "support/text.hpp"

namespace hamjet::test {

using Json = nlohmann::json;

/// A small scene with two integrators; lines 6 to 12 are its orbit, 13 to 15 its jet.
inline const std::string small_scene = short_kepler_scene("small") + R"([[integrator]]
label = "midpoint"
method = "gauss"
stages = 1
step_canonical = 0.01
[formation]
separation_km = 1
[generating_function]
kinds = ["F1", "F2"]
[reference]
)";

/// The small scene without the reference, which takes most of its time.
inline std::string quick_scene() { return changed(small_scene, "[reference]\n", ""); }

inline Json read_json(const std::filesystem::path& file) { return Json::parse(content(file)); }

inline Table read_table(const std::filesystem::path& file) { return parse_table(content(file)); }

/// The arguments, followed by each of the overrides after `--set`.
inline std::vector<std::string> with_overrides(std::vector<std::string> arguments,
                                               const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    arguments.insert(arguments.end(), {"--set", text});
  }
  return arguments;
}

/// Sum of the exponents in a row whose first field is a name and whose last field is a coefficient.
inline int degree(const std::vector<std::string>& row) {
  int sum = 0;
  for (std::size_t i = 1; i + 1 < row.size(); ++i) sum += std::stoi(row[i]);
  return sum;
}

/// The labels of the runs in the scene's text for which this build has no integrator.
inline std::vector<std::string> labels_not_built(const std::string& integrators,
                                                 const std::string& scene) {
  std::vector<std::string> labels;
  if (in_one_line(integrators).find("NOT BUILT") == std::string::npos) return labels;
  const auto quoted = [](const std::string& line) {
    const std::size_t first = line.find('"') + 1;
    return line.substr(first, line.find('"', first) - first);
  };
  std::istringstream lines(scene);
  std::string label;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("label = ")) label = quoted(line);
    if (line.starts_with("method = ") && quoted(line).starts_with("cvode")) labels.push_back(label);
  }
  return labels;
}

/// A test in a new empty directory, which is removed at the end.
class CommandTest : public ::testing::Test {
 protected:
  CommandTest() {
    options_.directory = directory_;
    write("small.toml", small_scene);
    write("quick.toml", quick_scene());
  }

  std::filesystem::path write(const std::filesystem::path& name, const std::string& text) const {
    std::ofstream(directory_ / name, std::ios::binary) << text;
    return directory_ / name;
  }

  /// Runs the command in the directory; the command must end in time.
  CommandResult hamjet(const std::vector<std::string>& arguments) const {
    const CommandResult result = run_command(arguments, options_);
    EXPECT_FALSE(result.is_timed_out) << result.err;
    return result;
  }

  /// Runs the command, which must succeed and print nothing on standard error.
  CommandResult succeed(const std::vector<std::string>& arguments) const {
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result;
  }

  /// The contents of the directory, with folders, in order and relative to it.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory_)) {
      names.push_back(entry.path().lexically_relative(directory_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// The command must fail with this code and one line on standard error that holds every one of
  /// `words`, print nothing on standard output, and change nothing in the directory.
  void expect_error(const std::vector<std::string>& arguments, int exit_code,
                    const std::vector<std::string>& words) const {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const auto before = files();
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.rfind("hamjet: ", 0), 0U) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& word : words) {
      EXPECT_NE(result.err.find(word), std::string::npos) << result.err << "lacks " << word;
    }
    EXPECT_EQ(files(), before);
  }

  const TemporaryDirectory temporary_directory_;
  const std::filesystem::path directory_ = temporary_directory_.path();
  CommandOptions options_;
};

}  // namespace hamjet::test
