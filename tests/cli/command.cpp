#include "command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace hamjet::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  return {ends[0], ends[1]};
}

/// A pseudo-terminal: the text that is written to one end as to a screen comes out of the other
/// end.
Pipe make_terminal() {
  const int screen = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (screen < 0 || ::grantpt(screen) != 0 || ::unlockpt(screen) != 0) {
    throw std::runtime_error("no terminal");
  }
  return {screen, ::open(::ptsname(screen), O_RDWR | O_NOCTTY | O_CLOEXEC)};
}

Pipe make_channel(Stream stream) {
  return stream == Stream::terminal ? make_terminal() : make_pipe();
}

void close_if_open(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

/// In the child process: replaces the stream.
void connect(Stream stream, const Pipe& pipe, int descriptor) {
  switch (stream) {
    case Stream::captured:
    case Stream::reader_gone:
    case Stream::terminal:
      ::dup2(pipe.write_end, descriptor);
      break;
    case Stream::closed:
      ::close(descriptor);
      break;
    case Stream::full: {
      const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
      if (full < 0) ::_exit(cannot_start);
      ::dup2(full, descriptor);
      break;
    }
  }
}

void limit(decltype(RLIMIT_AS) resource, const std::optional<rlim_t>& most) {
  if (!most) return;
  const rlimit value{*most, *most};
  if (::setrlimit(resource, &value) != 0) ::_exit(cannot_start);
}

[[noreturn]] void become_command(const std::vector<std::string>& arguments,
                                 const CommandOptions& options, const Pipe& out, const Pipe& err) {
  constexpr uid_t nobody = 65534;
  // A shell that runs tests in the background passes SIGINT on as ignored.
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  if (options.signal && options.signal->is_ignored) std::signal(options.signal->number, SIG_IGN);
  if (::chdir(options.directory.c_str()) != 0) ::_exit(cannot_start);
  for (const auto& [name, value] : options.environment) {
    if (value) {
      ::setenv(name.c_str(), value->c_str(), 1);
    } else {
      ::unsetenv(name.c_str());
    }
  }
  if (options.as_nobody && (::setgid(nobody) != 0 || ::setuid(nobody) != 0)) {
    ::_exit(cannot_start);
  }
  std::vector<char*> pointers;
  std::string command = HAMJET_COMMAND;
  std::vector<std::string> copies = arguments;
  pointers.push_back(command.data());
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  if (!options.has_input) ::close(STDIN_FILENO);
  if (!options.input.empty()) {
    const int input = ::open(options.input.c_str(), O_RDONLY | O_CLOEXEC);
    if (input < 0 || ::dup2(input, STDIN_FILENO) < 0) ::_exit(cannot_start);
  }
  connect(options.out, out, STDOUT_FILENO);
  connect(options.err, err, STDERR_FILENO);
  limit(RLIMIT_FSIZE, options.largest_file);
  limit(RLIMIT_AS, options.address_space);
  limit(RLIMIT_STACK, options.stack);
  ::execv(command.c_str(), pointers.data());
  ::_exit(cannot_start);
}

/// Whether the process catches the signal: the bit mask SigCgt of Linux.
bool catches(pid_t process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string key; status >> key;) {
    if (key != "SigCgt:") continue;
    std::string mask;
    status >> mask;
    return (std::strtoull(mask.c_str(), nullptr, 16) >> (signal - 1) & 1U) != 0;
  }
  return false;
}

/// Whether the process has ended; its parent must still wait for it.
bool has_ended(pid_t process) {
  siginfo_t information{};
  return ::waitid(P_PID, static_cast<id_t>(process), &information, WEXITED | WNOHANG | WNOWAIT) ==
             0 &&
         information.si_pid == process;
}

/// Waits until the file exists or the process has ended.
void wait_for_file(pid_t process, const std::filesystem::path& path) {
  constexpr std::chrono::microseconds interval(20);
  while (!path.empty() && ::access(path.c_str(), F_OK) != 0 && !has_ended(process)) {
    std::this_thread::sleep_for(interval);
  }
}

void send(pid_t process, const Signal& signal, Clock::time_point deadline) {
  while (!signal.is_ignored && !catches(process, signal.number) && !has_ended(process) &&
         Clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  wait_for_file(process, signal.path);
  for (int i = 0; i < signal.times; ++i) {
    std::this_thread::sleep_for(signal.after);
    ::kill(process, signal.number);
  }
}

void send(pid_t process, const Kill& kill) {
  wait_for_file(process, kill.path);
  std::this_thread::sleep_for(kill.after);
  ::kill(process, SIGKILL);
}

/// Reads both streams until the command has closed them; false if the time ran out.
bool read_streams(Pipe& out, Pipe& err, CommandResult& result, Clock::time_point deadline) {
  while (out.read_end >= 0 || err.read_end >= 0) {
    std::array<pollfd, 2> waiting = {pollfd{out.read_end, POLLIN, 0},
                                     pollfd{err.read_end, POLLIN, 0}};
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || ::poll(waiting.data(), waiting.size(), static_cast<int>(left)) == 0) {
      return false;
    }
    const auto take = [](pollfd& entry, int& descriptor, std::string& text) {
      if (entry.revents == 0) return;
      std::array<char, 65536> buffer;
      const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) return;
      if (count <= 0) return close_if_open(descriptor);
      text.append(buffer.data(), static_cast<std::size_t>(count));
    };
    take(waiting[0], out.read_end, result.out);
    take(waiting[1], err.read_end, result.err);
  }
  return true;
}

/// Waits for the end; false if the time ran out.
bool wait_for_end(pid_t process, int& status, rusage& usage, Clock::time_point deadline) {
  while (::wait4(process, &status, WNOHANG, &usage) == 0) {
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return true;
}

}  // namespace

CommandResult run_command(const std::vector<std::string>& arguments,
                          const CommandOptions& options) {
  Pipe out = make_channel(options.out);
  Pipe err = make_channel(options.err);
  if (options.out == Stream::reader_gone) close_if_open(out.read_end);
  if (options.err == Stream::reader_gone) close_if_open(err.read_end);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) become_command(arguments, options, out, err);
  close_if_open(out.write_end);
  close_if_open(err.write_end);
  const auto deadline = Clock::now() + options.limit;
  CommandResult result;
  int status = 0;
  rusage usage{};
  if (options.signal) send(process, *options.signal, deadline);
  if (options.kill) send(process, *options.kill);
  result.is_timed_out =
      !read_streams(out, err, result, deadline) || !wait_for_end(process, status, usage, deadline);
  if (result.is_timed_out) {
    ::kill(process, SIGKILL);
    ::waitpid(process, &status, 0);
  }
  close_if_open(out.read_end);
  close_if_open(err.read_end);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.peak_resident_bytes = usage.ru_maxrss * 1024;
  return result;
}

}  // namespace hamjet::test
