#include "concurrent_tasks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace hamjet {
namespace {

/// Ends a task because another one failed; it never leaves run_concurrently.
struct Abandoned {};

constexpr std::chrono::milliseconds between_polls{20};

class AloneControl : public TaskControl {
 public:
  explicit AloneControl(const std::function<void(long)>& poll) : poll_(poll) {}
  void advance() override { poll_(++done_); }

 private:
  const std::function<void(long)>& poll_;
  long done_ = 0;
};

/// The state that the threads share.
class SharedControl : public TaskControl {
 public:
  SharedControl(std::size_t count, const std::function<void(std::size_t, TaskControl&)>& task)
      : count_(count), task_(task), failures_(count) {}

  void advance() override {
    done_.fetch_add(1, std::memory_order_relaxed);
    if (is_ending_.load(std::memory_order_relaxed)) throw Abandoned{};
  }

  /// The work of each thread: runs tasks until none is left.
  void work() {
    while (!is_ending_) {
      const std::size_t i = next_++;
      if (i >= count_) break;
      try {
        task_(i, *this);
      } catch (const Abandoned&) {
      } catch (...) {
        failures_[i] = std::current_exception();
        is_ending_ = true;
      }
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }

  /// Waits until this number of threads have ended.
  void wait(std::size_t threads, const std::function<void(long)>& poll) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, between_polls, [&] { return ended_ == threads; })) {
      lock.unlock();
      poll(done_);
      lock.lock();
    }
  }

  void end() { is_ending_ = true; }
  void rethrow() const {
    for (const std::exception_ptr& failure : failures_) {
      if (failure) std::rethrow_exception(failure);
    }
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t, TaskControl&)>& task_;
  std::vector<std::exception_ptr> failures_;
  std::atomic<std::size_t> next_{0};
  std::atomic<long> done_{0};
  std::atomic<bool> is_ending_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t ended_ = 0;
};

std::size_t run_alone(std::size_t count, const std::function<void(std::size_t, TaskControl&)>& task,
                      const std::function<void(long)>& poll) {
  AloneControl control(poll);
  for (std::size_t i = 0; i < count; ++i) task(i, control);
  return 1;
}

}  // namespace

std::size_t run_concurrently(std::size_t count, std::size_t threads,
                             const std::function<void(std::size_t, TaskControl&)>& task,
                             const std::function<void(long)>& poll) {
  threads = std::min(threads, count);
  if (threads <= 1) return run_alone(count, task, poll);
  SharedControl control(count, task);
  std::vector<std::jthread> workers;
  try {
    try {
      for (std::size_t t = 0; t < threads; ++t) workers.emplace_back([&] { control.work(); });
    } catch (const std::system_error&) {
      // No more threads can be started, so that the running threads do the work.
    }
    if (workers.empty()) return run_alone(count, task, poll);
    control.wait(workers.size(), poll);
  } catch (...) {
    control.end();  // the destructors of `workers` wait for them
    throw;
  }
  const std::size_t used = workers.size();
  workers.clear();
  control.rethrow();
  return used;
}

}  // namespace hamjet
