#pragma once

#include <functional>
#include <string>

namespace hamjet {

/// Told how far the work is: what is being done, and the fraction of it in 0..1. May throw to stop.
using ProgressCallback = std::function<void(const std::string& task, double fraction)>;

}  // namespace hamjet
