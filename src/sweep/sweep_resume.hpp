#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sweep_items.hpp"

namespace hamjet::io {

/// What a sweep that goes on after an interruption finds.
struct SweepResume {
  std::vector<std::size_t> remaining;  ///< the items that are still to be computed
  std::size_t failed = 0;              ///< items that failed and are not computed again
};

/// Of these items, those without a row that is whole are to be computed, and those that failed for
/// what may have been another machine's, or another moment's, lack of memory or of a file. `look`
/// is called after each row and may throw to stop. Throws Error(input_output) as
/// SweepDirectory::read.
SweepResume resume_sweep(const std::vector<std::size_t>& items, const SweepDirectory& directory,
                         const std::function<void()>& look);

}  // namespace hamjet::io
