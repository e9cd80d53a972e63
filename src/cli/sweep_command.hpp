#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "scene_options.hpp"

namespace hamjet::cli {

struct SweepOptions {
  std::optional<std::string> study;  ///< may be left out of a merge
  std::optional<long> threads;
  std::optional<std::string> shard;  ///< "k/n"
  bool resume = false;
  bool merge = false;
};

/// `hamjet sweep`: the items of a study on this machine's cores, or a part of them; the table; or a
/// job script. Returns the exit code: 1 if items have failed, or of a merge are missing. Throws
/// what `io::read_sweep_study`, `check_sweep_items` and SweepDirectory throw, Error(usage) for
/// options that do not go together.
int sweep(const RunOptions& run, const SweepOptions& options);

}  // namespace hamjet::cli
