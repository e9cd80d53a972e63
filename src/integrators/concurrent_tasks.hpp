#pragma once

#include <cstddef>
#include <functional>

namespace hamjet {

/// The interface between a task of run_concurrently and the whole.
class TaskControl {
 public:
  virtual ~TaskControl() = default;
  /// A task must call this now and then. It counts a unit of work as done, and throws if the tasks
  /// are to end.
  virtual void advance() = 0;
};

/// Runs task(0), ..., task(count - 1), each once, on up to `threads` threads; on the calling thread
/// alone if `threads` is 1 or no other thread can be started. `poll` is called from the calling
/// thread with the units of work done so far, every few hundredths of a second or, with one thread,
/// at every advance(); it may throw. A failure of a task or of `poll` ends the other tasks at their
/// next advance() and is thrown; if several tasks have failed, it is that of the lowest one.
/// Returns the number of threads that worked.
std::size_t run_concurrently(std::size_t count, std::size_t threads,
                             const std::function<void(std::size_t task, TaskControl&)>& task,
                             const std::function<void(long done)>& poll);

}  // namespace hamjet
