#pragma once

#include "scene_options.hpp"

namespace hamjet::cli {

/// The study of validity in all coordinates, side by side; writes the results and returns the exit
/// code.
int validity_in_all_coordinates(const RunOptions& options);

}  // namespace hamjet::cli
