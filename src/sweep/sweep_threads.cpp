#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>

#include "../store/held_signals.hpp"
#include "hamjet/error.hpp"
#include "sweep_items.hpp"

namespace hamjet::io {
namespace {

/// Thrown through the work of an item that is given up. It is no std::exception, so that nothing on
/// the way takes it for a failure.
struct GivenUp {};

/// What the threads share.
struct SharedState {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::condition_variable_any changed;
  SweepProgress progress;
  std::size_t threads_at_work = 0;
  std::exception_ptr error;  ///< the first
};

void work(const SweepStudy& study, const SweepDirectory& directory,
          const std::vector<std::size_t>& items, SharedState& shared, const std::stop_token& stop) {
  try {
    for (std::size_t i = shared.next++; i < items.size(); i = shared.next++) {
      const SweepRow row = run_sweep_item(study, items[i], [&](const std::string&, double) {
        if (stop.stop_requested()) throw GivenUp();
      });
      // A mistake in a column shows at once, and not after all have been computed.
      if (i == 0 && !row.astray.empty()) throw Error(ErrorKind::scene, row.astray);
      directory.write(row);
      {
        const std::lock_guard lock(shared.mutex);
        ++shared.progress.finished;
        if (row.exit_code != 0) ++shared.progress.failed;
      }
      if (stop.stop_requested()) throw GivenUp();
    }
  } catch (const GivenUp&) {
  } catch (...) {
    const std::lock_guard lock(shared.mutex);
    if (!shared.error) shared.error = std::current_exception();
  }
  const std::lock_guard lock(shared.mutex);
  --shared.threads_at_work;
  shared.changed.notify_all();
}

}  // namespace

SweepProgress run_sweep_items(const SweepStudy& study, const SweepDirectory& directory,
                              const std::vector<std::size_t>& items, std::size_t threads,
                              const std::function<void(const SweepProgress&)>& watch,
                              SweepProgress* reached) {
  constexpr std::chrono::milliseconds interval(100);
  SharedState shared;
  std::vector<std::jthread> workers;  // declared last: joined before what they use goes
  {
    // Signals of the user go to the calling thread.
    const HeldSignals held;
    const std::size_t count = std::min(threads, items.size());
    shared.threads_at_work = count;
    try {
      while (workers.size() < count) {
        workers.emplace_back(
            [&](const std::stop_token& stop) { work(study, directory, items, shared, stop); });
      }
    } catch (const std::system_error&) {
      // If no more threads can be had, those that run do the work.
      if (workers.empty()) throw;
      const std::lock_guard lock(shared.mutex);
      shared.threads_at_work -= count - workers.size();
    }
  }
  const auto stop_all = [&] {
    for (std::jthread& worker : workers) worker.request_stop();
  };
  try {
    std::unique_lock lock(shared.mutex);
    while (shared.threads_at_work > 0 && !shared.error) {
      shared.changed.wait_for(lock, interval);
      const SweepProgress progress = shared.progress;
      lock.unlock();
      watch(progress);
      lock.lock();
    }
  } catch (...) {
    stop_all();
    workers.clear();
    if (reached != nullptr) *reached = shared.progress;
    throw;
  }
  stop_all();
  workers.clear();
  if (shared.error) std::rethrow_exception(shared.error);
  return shared.progress;
}

}  // namespace hamjet::io
