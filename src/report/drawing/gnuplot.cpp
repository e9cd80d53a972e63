#include "gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "hamjet/error.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has it in no header

namespace hamjet::io {
namespace {

using Clock = std::chrono::steady_clock;

std::string errno_text(int error) { return std::strerror(error); }  // NOLINT(concurrency-mt-unsafe)

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() { close(); }
  int value() const { return value_; }
  bool is_open() const { return value_ >= 0; }
  void close() {
    if (value_ >= 0) ::close(std::exchange(value_, -1));
  }

 private:
  int value_ = -1;
};

/// A channel to a child. A pair of sockets and not a pipe: writing to a child that has ended must
/// not raise SIGPIPE in this process.
struct Channel {
  Descriptor ours;
  Descriptor theirs;

  Channel() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw Error(ErrorKind::input_output,
                  fmt::format("gnuplot cannot be started: {}", errno_text(errno)));
    }
    ours = Descriptor(ends[0]);
    theirs = Descriptor(ends[1]);
    ::fcntl(ours.value(), F_SETFL, O_NONBLOCK);
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
  for (const int s : {SIGINT, SIGTERM, SIGPIPE, SIGHUP}) sigaddset(&signals, s);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string name = program;
  std::string without_settings = "--default-settings";
  const std::array<char*, 3> arguments = {name.data(), without_settings.data(), nullptr};
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

void send_some(Descriptor& to, std::string_view& text) {
  const ssize_t sent = ::send(to.value(), text.data(), text.size(), MSG_NOSIGNAL);
  if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
  const bool is_broken = sent < 0 && errno != EINTR && errno != EAGAIN;
  if (is_broken || text.empty()) to.close();
}

void receive_some(Descriptor& from, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t received = ::read(from.value(), buffer.data(), buffer.size());
  if (received > 0) text.append(buffer.data(), static_cast<std::size_t>(received));
  const bool is_broken = received < 0 && errno != EINTR && errno != EAGAIN;
  if (received == 0 || is_broken) from.close();
}

/// Feeds the script and collects both outputs until they are closed. False at the deadline.
bool converse(Channel& input, Channel& output, Channel& errors, std::string_view script,
              GnuplotOutcome& outcome, Clock::time_point deadline) {
  while (output.ours.is_open() || errors.ours.is_open()) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    // A closed descriptor is -1, which poll leaves out.
    std::array<pollfd, 3> events = {{{input.ours.value(), POLLOUT, 0},
                                     {output.ours.value(), POLLIN, 0},
                                     {errors.ours.value(), POLLIN, 0}}};
    const int timeout = static_cast<int>(std::min<long long>(left, 1000));
    if (::poll(events.data(), events.size(), timeout) <= 0) continue;
    if (events[0].revents != 0) send_some(input.ours, script);
    if (events[1].revents != 0) receive_some(output.ours, outcome.output);
    if (events[2].revents != 0) receive_some(errors.ours, outcome.problem);
  }
  return true;
}

/// Waits for the child's end; false at the deadline.
bool wait_for(pid_t child, int& status, Clock::time_point deadline) {
  for (;;) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return true;
    if (Clock::now() >= deadline) return false;
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

}  // namespace

GnuplotOutcome run_gnuplot(const std::string& program, std::string_view script,
                           std::chrono::milliseconds limit) {
  GnuplotOutcome outcome;
  const auto deadline = Clock::now() + limit;
  Channel input;
  Channel output;
  Channel errors;
  pid_t child = 0;
  const int error =
      start(program, {input.theirs.value(), output.theirs.value(), errors.theirs.value()}, child);
  if (error != 0) {
    outcome.is_installed = false;
    outcome.problem = error == ENOENT
                          ? fmt::format("{} is not installed, so there are no plots", program)
                          : fmt::format("{} cannot be started, so there are no plots: {}", program,
                                        errno_text(error));
    return outcome;
  }
  for (Channel* channel : {&input, &output, &errors}) channel->theirs.close();
  int status = 0;
  const bool is_in_time = converse(input, output, errors, script, outcome, deadline) &&
                          wait_for(child, status, deadline);
  if (!is_in_time) {
    ::kill(-child, SIGKILL);
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.output.clear();
    outcome.is_late = true;
    outcome.problem = fmt::format("{} took longer than {} s and was ended", program,
                                  static_cast<double>(limit.count()) / 1000);
    return outcome;
  }
  const std::string said = last_line(std::exchange(outcome.problem, {}));
  const bool is_well = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !outcome.output.empty();
  if (!is_well) {
    outcome.output.clear();
    // Status 127 is how some systems tell of a program that is not there.
    outcome.is_installed = !(WIFEXITED(status) && WEXITSTATUS(status) == 127);
    outcome.problem =
        outcome.is_installed
            ? fmt::format("{} failed: {}", program, said.empty() ? "it drew nothing" : said)
            : fmt::format("{} is not installed, so there are no plots", program);
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
