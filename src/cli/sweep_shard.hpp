#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hamjet::cli {

/// The part k of n of a sweep, k from 1: every n-th item, so that parts take equally long where the
/// work grows along an axis.
struct Shard {
  std::size_t part = 1;
  std::size_t parts = 1;

  std::vector<std::size_t> items(std::size_t count) const;
};

/// Reads a part such as "3/20". Throws Error(usage).
Shard parse_shard(const std::string& text);

/// The task of an array of Slurm that this process is: from SLURM_ARRAY_TASK_ID, _COUNT, _MIN and
/// _STEP; none outside an array. Throws Error(usage) where the array is not evenly spaced, so that
/// the task's place in it is unknown.
std::optional<Shard> slurm_shard(const std::function<const char*(const char*)>& environment);

}  // namespace hamjet::cli
