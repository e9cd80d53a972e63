#pragma once

#include <functional>
#include <string>

namespace hamjet {

/// Called with the present task and the fraction of it that is done, in 0..1. It may throw to stop.
using ProgressCallback = std::function<void(const std::string& task, double fraction)>;

}  // namespace hamjet
