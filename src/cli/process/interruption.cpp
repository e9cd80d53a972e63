#include "interruption.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

#include "../../store/held_signals.hpp"
#include "hamjet/error.hpp"
#include "standard_streams.hpp"

namespace hamjet::cli {
namespace {

/// `finished`: the results are there, or the line that says why not all of them are.
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

/// Set while one thread tells how the program ends.
std::atomic_flag is_ending;

/// Waits until no other thread tells how the program ends.
void take_turn() {
  constexpr timespec interval{0, 1'000'000};
  while (is_ending.test_and_set()) ::nanosleep(&interval, nullptr);
}

/// Ends the program from within a signal handler, where nothing that allocates or locks may be
/// called. In the midst of writing this is as if it were killed: the results in the directory are
/// whole, the old ones (or none) or the new, and what is hidden there the next run puts in order.
[[noreturn]] void end_at_once() {
  take_turn();
  remove_leftovers();
  if (phase != finished) {
    const std::string_view message =
        phase == writing
            ? "hamjet: interrupted while the results were written; they are there, whole, or what "
              "was there before\n"
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
  // None of them interrupts the handler of another.
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  for (const int signal : io::ending_signals) sigaddset(&action.sa_mask, signal);
  sigaddset(&action.sa_mask, SIGALRM);
  action.sa_flags = SA_RESTART;
  action.sa_handler = lose_patience;
  ::sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = remember_signal;
  for (const int signal : io::ending_signals) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // Whoever starts the program by nohup, or in the background, wants it to outlive the terminal.
    const bool is_of_terminal = signal == SIGHUP || signal == SIGQUIT;
    if (is_of_terminal && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void note_finished_part() { has_checkpoint = 1; }

int end_interrupted(const Interrupted& interrupted, const std::string& message) {
  const io::HeldSignals held;
  take_turn();
  print_error(message);
  phase = finished;
  is_ending.clear();
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
  // After partial results the line that says that they are partial is still to come.
  if (what_ != Writing::results) note_finished_part();
  phase = what_ != Writing::results ? computing : finished;
}

}  // namespace hamjet::cli
