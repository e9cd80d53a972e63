#pragma once

#include <cstddef>

namespace hamjet::cli {

/// Processors that this process may run on: those of its affinity, and of its task where Slurm says
/// how many a task has. At least 1.
std::size_t usable_processors();

}  // namespace hamjet::cli
