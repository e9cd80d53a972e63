#pragma once

#include "scene_options.hpp"

namespace hamjet::cli {

/// Runs a scene and writes its results; returns the exit code.
int run(const RunOptions& options);

/// Reads a scene and says what would be computed; returns the exit code.
int check(const RunOptions& options);

}  // namespace hamjet::cli
