#include "gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>
#include <utility>

#include "../../store/file_system.hpp"
#include "../../store/held_signals.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has it in no header

namespace hamjet::io {
namespace {

using Clock = std::chrono::steady_clock;

std::string errno_text(int error) { return std::strerror(error); }  // NOLINT(concurrency-mt-unsafe)

/// A file without a name, in memory, from which a child reads the script. Returns 0 or the error.
int put_into_memory(std::string_view script, Descriptor& file) {
  file = Descriptor(::memfd_create("gnuplot script", MFD_CLOEXEC));
  if (!file.is_open()) return errno;
  while (!script.empty()) {
    const ssize_t count = ::write(file.value(), script.data(), script.size());
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) script.remove_prefix(static_cast<std::size_t>(count));
  }
  return ::lseek(file.value(), 0, SEEK_SET) == 0 ? 0 : errno;
}

/// A channel from a child.
struct Channel {
  Descriptor ours;
  Descriptor theirs;

  /// Returns 0 or the error.
  int open() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
    ours = Descriptor(ends[0]);
    theirs = Descriptor(ends[1]);
    ::fcntl(ours.value(), F_SETFL, O_NONBLOCK);
    return 0;
  }
};

/// Starts the program in a process group of its own, so that Ctrl-C at the terminal does not cut a
/// drawing short that the report is waiting for. Returns 0 or the error.
int start(const std::string& program, const std::array<int, 3>& streams, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < 3; ++i) {
    posix_spawn_file_actions_adddup2(&actions, streams[static_cast<std::size_t>(i)], i);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int s : ending_signals) sigaddset(&signals, s);
  sigaddset(&signals, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string name = program;
  std::string without_settings = "--default-settings";
  // gnuplot reads standard input itself byte by byte, but a file, by whatever name, in one piece.
  std::string script = "/dev/stdin";
  const std::array<char*, 4> arguments = {name.data(), without_settings.data(), script.data(),
                                          nullptr};
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

void receive_some(Descriptor& from, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t received = ::read(from.value(), buffer.data(), buffer.size());
  if (received > 0) text.append(buffer.data(), static_cast<std::size_t>(received));
  const bool is_broken = received < 0 && errno != EINTR && errno != EAGAIN;
  if (received == 0 || is_broken) from.close();
}

/// The child and the channels to it.
struct Child {
  pid_t process = 0;
  Channel output;
  Channel errors;

  /// Starts the program with the script; returns 0 or the error.
  int start(const std::string& program, std::string_view script) {
    Descriptor input;
    if (const int error = put_into_memory(script, input)) return error;
    for (Channel* channel : {&output, &errors}) {
      if (const int error = channel->open()) return error;
    }
    const int error =
        io::start(program, {input.value(), output.theirs.value(), errors.theirs.value()}, process);
    for (Channel* channel : {&output, &errors}) channel->theirs.close();
    return error;
  }

  /// Starts it once more as long as the system lacks what it may have in a moment.
  int start_patiently(const std::string& program, std::string_view script) {
    constexpr int attempts = 5;
    auto pause = std::chrono::milliseconds(20);
    for (int attempt = 1;; ++attempt, pause *= 2) {
      *this = {};
      const int error = start(program, script);
      const bool may_pass =
          error == EAGAIN || error == EMFILE || error == ENFILE || error == ENOMEM;
      if (!may_pass || attempt == attempts) return error;
      std::this_thread::sleep_for(pause);
    }
  }

  /// The processor time that it has taken so far.
  std::chrono::nanoseconds processor_time() const {
    clockid_t clock{};
    timespec taken{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &taken) != 0) {
      return {};  // it has ended
    }
    return std::chrono::seconds(taken.tv_sec) + std::chrono::nanoseconds(taken.tv_nsec);
  }
};

/// Says when a child has had its time.
class Patience {
 public:
  explicit Patience(const GnuplotLimits& limits) : limits_(limits) {}

  /// What the child has taken too much of; empty as long as it may go on.
  std::string exceeded(const Child& child) const {
    const auto seconds = [](std::chrono::milliseconds limit) {
      return static_cast<double>(limit.count()) / 1000;
    };
    if (child.processor_time() > limits_.processor) {
      return fmt::format("took longer than {} s of processor time", seconds(limits_.processor));
    }
    if (Clock::now() - start_ > limits_.whole) {
      return fmt::format("took longer than {} s", seconds(limits_.whole));
    }
    return "";
  }

 private:
  GnuplotLimits limits_;
  Clock::time_point start_ = Clock::now();
};

/// Collects both outputs until they are closed. Returns what the child took too much of, or
/// nothing.
std::string listen_to(Child& child, GnuplotOutcome& outcome, const Patience& patience) {
  constexpr int interval_ms = 50;
  while (child.output.ours.is_open() || child.errors.ours.is_open()) {
    if (std::string exceeded = patience.exceeded(child); !exceeded.empty()) return exceeded;
    // A closed descriptor is -1, which poll leaves out.
    std::array<pollfd, 2> events = {
        {{child.output.ours.value(), POLLIN, 0}, {child.errors.ours.value(), POLLIN, 0}}};
    if (::poll(events.data(), events.size(), interval_ms) <= 0) continue;
    if (events[0].revents != 0) receive_some(child.output.ours, outcome.output);
    if (events[1].revents != 0) receive_some(child.errors.ours, outcome.problem);
  }
  return "";
}

/// Waits for the child's end. Returns what it took too much of, or nothing.
std::string wait_for(const Child& child, int& status, const Patience& patience) {
  for (;;) {
    const pid_t ended = ::waitpid(child.process, &status, WNOHANG);
    if (ended == child.process || (ended < 0 && errno != EINTR)) return "";
    if (std::string exceeded = patience.exceeded(child); !exceeded.empty()) return exceeded;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// The last line that says something: gnuplot prints the line of the script and a caret before it.
std::string last_line(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view candidate = text.substr(0, end);
    if (candidate.find_first_not_of(" \t\r^") != std::string_view::npos) line = candidate;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  line.erase(0, line.find_first_not_of(' '));
  return line;
}

/// Why a child that has ended drew nothing, by what it said or else by how it ended.
std::string reason_of(int status, const std::string& said) {
  if (!said.empty()) return said;
  if (WIFSIGNALED(status)) return fmt::format("it was ended by signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return fmt::format("exit code {}", WEXITSTATUS(status));
  return "it drew nothing";
}

}  // namespace

GnuplotOutcome run_gnuplot(const std::string& program, std::string_view script,
                           const GnuplotLimits& limits) {
  GnuplotOutcome outcome;
  Child child;
  if (const int error = child.start_patiently(program, script)) {
    outcome.is_started = false;
    outcome.problem = error == ENOENT
                          ? fmt::format("{} is not installed, so there are no plots", program)
                          : fmt::format("{} cannot be started, so there are no plots: {}", program,
                                        errno_text(error));
    return outcome;
  }
  const Patience patience(limits);
  int status = 0;
  std::string exceeded = listen_to(child, outcome, patience);
  if (exceeded.empty()) exceeded = wait_for(child, status, patience);
  if (!exceeded.empty()) {
    ::kill(-child.process, SIGKILL);
    while (::waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.output.clear();
    outcome.is_late = true;
    outcome.problem = fmt::format("{} {} and was ended", program, exceeded);
    return outcome;
  }
  const std::string said = last_line(std::exchange(outcome.problem, {}));
  const bool is_well = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !outcome.output.empty();
  if (!is_well) {
    outcome.output.clear();
    outcome.problem = fmt::format("{} failed: {}", program, reason_of(status, said));
  }
  return outcome;
}

std::string gnuplot_literal(std::string_view text) {
  const std::size_t leading = std::min(text.find_first_not_of('\''), text.size());
  std::string literal;
  if (leading > 0) literal = '"' + std::string(text.substr(0, leading)) + "\".";
  text.remove_prefix(leading);
  literal += '\'';
  for (const char c : text) {
    if (c == '\'') literal += '\'';
    literal += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return literal + "'";
}

}  // namespace hamjet::io
