#include "interruption.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

#include "hamjet/error.hpp"
#include "standard_streams.hpp"

namespace hamjet::cli {
namespace {

/// `finished`: the results, or the line that says why there are none, are there.
enum Phase : std::sig_atomic_t { computing, writing, finished };

volatile std::sig_atomic_t pending_signal = 0;
volatile std::sig_atomic_t phase = computing;
volatile std::sig_atomic_t has_checkpoint = 0;

/// The paths of the RemovedAtSuddenEnd that lives, ended by a null pointer.
const char* const* volatile names_at_sudden_end = nullptr;

/// Time that the work has to stop, short enough that the end comes within a second.
constexpr suseconds_t microseconds_to_stop = 700'000;

void set_alarm() {
  itimerval timer{};
  timer.it_value.tv_usec = microseconds_to_stop;
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

void remove_leftovers() {
  const char* const* name = names_at_sudden_end;
  // unlink removes files and rmdir folders; each fails harmlessly on the other.
  for (; name != nullptr && *name != nullptr; ++name) {
    ::unlink(*name);
    ::rmdir(*name);
  }
}

/// Ends the program from within a signal handler, where nothing that allocates or locks may be
/// called. In the midst of writing this is as if it were killed: the results in the directory are
/// whole, the old ones or the new.
[[noreturn]] void end_at_once() {
  remove_leftovers();
  if (phase != finished) {
    const std::string_view message =
        phase == writing
            ? "hamjet: interrupted while the results were written; the old ones or the new ones "
              "are there, whole\n"
        : has_checkpoint != 0
            ? "hamjet: interrupted; the results hold what was finished shortly before\n"
            : "hamjet: interrupted; nothing was written\n";
    [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, message.data(), message.size());
  }
  ::_exit(128 + pending_signal);
}

extern "C" void remember_signal(int signal) {
  const bool is_repeated = pending_signal != 0;
  pending_signal = signal;
  if (phase == finished || is_repeated) end_at_once();
  set_alarm();
}

extern "C" void lose_patience(int /*signal*/) { end_at_once(); }

}  // namespace

void catch_signals() {
  std::signal(SIGALRM, lose_patience);
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

HeldSignals::HeldSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : {SIGALRM, SIGINT, SIGTERM}) sigaddset(&held, signal);
  ::pthread_sigmask(SIG_BLOCK, &held, &before_);
}

HeldSignals::~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

int end_interrupted(const Interrupted& interrupted, const std::string& message) {
  const HeldSignals held;
  print_error(message);
  phase = finished;
  return interrupted.exit_code();
}

void end_after_unhandled_exception() noexcept {
  try {
    if (const auto cause = std::current_exception()) std::rethrow_exception(cause);
  } catch (const std::bad_alloc&) {
    remove_leftovers();
    print_error(out_of_memory);
    ::_exit(static_cast<int>(ErrorKind::too_large));
  } catch (...) {
    remove_leftovers();
  }
  std::abort();
}

void stop_if_interrupted() {
  if (pending_signal != 0) throw Interrupted(pending_signal);
}

void RemovedAtSuddenEnd::watch(std::vector<std::filesystem::path> paths) {
  paths_ = std::move(paths);
  for (const auto& path : paths_) names_.push_back(path.c_str());
  names_.push_back(nullptr);
  names_at_sudden_end = names_.data();
}

RemovedAtSuddenEnd::~RemovedAtSuddenEnd() { names_at_sudden_end = nullptr; }

UninterruptedWriting::UninterruptedWriting(Writing what) : what_(what) {
  phase = writing;
  // What is finished gets a second of its own.
  if (pending_signal != 0 && what == Writing::partial_results) set_alarm();
  if (pending_signal != 0 && what != Writing::partial_results) {
    phase = computing;
    throw Interrupted(pending_signal);
  }
}

UninterruptedWriting::~UninterruptedWriting() {
  // After partial results the line that says so is still to come.
  if (what_ != Writing::results) has_checkpoint = 1;
  phase = what_ != Writing::results ? computing : finished;
}

}  // namespace hamjet::cli
