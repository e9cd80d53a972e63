#pragma once

#include "scene_options.hpp"

namespace hamjet::cli {

/// Stands behind the scene's name in that of the folder of the results.
inline constexpr const char* uncertainty_suffix = "-uncertainty";

/// The moments of the scene's uncertain states along time. Writes its results and returns the exit
/// code; Error(scene) if the scene has no table for it.
int uncertainty(const RunOptions& options);

}  // namespace hamjet::cli
