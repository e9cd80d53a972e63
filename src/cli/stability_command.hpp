#pragma once

#include <optional>
#include <string>

#include "scene_options.hpp"

namespace hamjet::cli {

/// Runs every case of a suite and reports how it came out; see io::stability_report. Without
/// `suite` that of the source tree is taken. Throws Error(input_output), Error(scene).
int stability(const RunOptions& options, const std::optional<std::string>& suite);

}  // namespace hamjet::cli
