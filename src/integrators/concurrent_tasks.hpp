#pragma once

#include <cstddef>
#include <functional>

namespace hamjet {

/// What the tasks of run_concurrently see of the whole.
class TaskControl {
 public:
  virtual ~TaskControl() = default;
  /// To be called by a task now and then: counts a unit of work as done, and throws if the tasks
  /// are to end.
  virtual void advance() = 0;
};

/// Runs task(0), ..., task(count - 1), each once, on up to `threads` threads; on the calling one
/// alone where that is 1 or no other can be started. `poll` is called from the calling thread with
/// the units of work done so far, every few hundredths of a second or, with one thread, at every
/// advance(); it may throw. The first failure, of the lowest task that failed before it, or of
/// `poll`, ends the others at their next advance() and is thrown. Returns the number of threads
/// that worked.
std::size_t run_concurrently(std::size_t count, std::size_t threads,
                             const std::function<void(std::size_t task, TaskControl&)>& task,
                             const std::function<void(long done)>& poll);

}  // namespace hamjet
