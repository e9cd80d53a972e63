#include "interruptible.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "../app/arithmetic.hpp"

namespace hamjet::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds between_looks(50);
constexpr std::chrono::milliseconds patience(500);

/// Thrown out of work whose result nobody waits for any more.
struct Abandoned {};

/// What the working and the waiting thread share.
struct Shared {
  std::atomic<bool> is_abandoned = false;
  std::mutex mutex;
  std::condition_variable ended;
  // Under the mutex:
  bool has_ended = false;
  std::exception_ptr failure;
  std::string task;
  double fraction = 0;
  bool has_news = false;
};

void work_in_thread(LongWork work, const std::shared_ptr<Shared>& shared) {
  std::exception_ptr failure;
  try {
    cli::reset_arithmetic();
    work([&shared](const std::string& task, double fraction) {
      if (shared->is_abandoned) throw Abandoned();
      const std::lock_guard lock(shared->mutex);
      shared->task = task;
      shared->fraction = fraction;
      shared->has_news = true;
    });
  } catch (...) {
    failure = std::current_exception();
  }
  work = nullptr;
  const std::lock_guard lock(shared->mutex);
  shared->failure = std::move(failure);
  shared->has_ended = true;
  shared->ended.notify_all();
}

/// Looks for signals and reports progress. Called with the lock, which is released meanwhile.
void look(Shared& shared, std::unique_lock<std::mutex>& lock, const py::object& progress) {
  const bool has_news = std::exchange(shared.has_news, false);
  const std::string task = shared.task;
  const double fraction = shared.fraction;
  lock.unlock();
  {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (has_news && !progress.is_none()) progress(task, fraction);
  }
  lock.lock();
}

}  // namespace

void do_interruptibly(LongWork work, const py::object& progress) {
  const auto shared = std::make_shared<Shared>();
  std::exception_ptr interruption;
  {
    const py::gil_scoped_release no_gil;
    std::thread thread(work_in_thread, std::move(work), shared);
    std::unique_lock lock(shared->mutex);
    const auto has_ended = [&] { return shared->has_ended; };
    try {
      while (!shared->ended.wait_for(lock, between_looks, has_ended)) {
        look(*shared, lock, progress);
      }
      if (!shared->failure) look(*shared, lock, progress);
    } catch (...) {
      interruption = std::current_exception();
      shared->is_abandoned = true;
      if (!lock.owns_lock()) lock.lock();
      shared->ended.wait_for(lock, patience, has_ended);
    }
    const bool is_over = shared->has_ended;
    lock.unlock();
    is_over ? thread.join() : thread.detach();
  }
  if (interruption) std::rethrow_exception(interruption);
  if (shared->failure) std::rethrow_exception(shared->failure);
}

void SignalCheck::operator()() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < between_looks) return;
  last_ = now;
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace hamjet::python
