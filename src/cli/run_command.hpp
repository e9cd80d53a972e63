#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hamjet::cli {

/// Options of `run`, `demo` and `check`.
struct RunOptions {
  std::optional<std::string> scene_file;  ///< absent: the built-in scene
  std::optional<std::string> output;
  std::vector<std::string> overrides;  ///< key=value
  bool json = false;
  bool quiet = false;
};

/// Runs a scene and writes its results; returns the exit code.
int run(const RunOptions& options);

/// Reads a scene and says what would be computed; returns the exit code.
int check(const RunOptions& options);

}  // namespace hamjet::cli
