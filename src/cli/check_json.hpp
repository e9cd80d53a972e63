#pragma once

#include "scene_options.hpp"

namespace hamjet::cli {

/// Prints what `hamjet check` says as JSON: the scene and what would be computed, by the names of
/// summary.json, or what is wrong with it. Returns the exit code, or throws what is wrong after it
/// was printed.
int check_as_json(const RunOptions& options);

}  // namespace hamjet::cli
