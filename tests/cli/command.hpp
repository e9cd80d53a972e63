#pragma once

#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Runs the built command as a user does, and returns its results.

namespace hamjet::test {

/// The destination of the command's standard output or standard error.
enum class Stream {
  captured,
  closed,
  full,         ///< /dev/full: every write fails as on a full disk
  reader_gone,  ///< a pipe that nobody reads, as after `| head`
  terminal      ///< captured, although the command sees a terminal
};

struct Signal {
  int number = 0;
  int times = 1;
  /// The range of moments between the command's start, or the moment at which `path` exists, and
  /// its end.
  std::chrono::milliseconds after{200};
  std::filesystem::path path = {};
  /// Whether the command is started with the signal ignored, as by nohup.
  bool is_ignored = false;
};

/// SIGKILL, which no program can catch.
struct Kill {
  std::chrono::microseconds after{0};  ///< the start, or the moment at which `path` exists
  std::filesystem::path path = {};
};

struct CommandOptions {
  std::filesystem::path directory;  ///< the working directory
  /// Variables to set, or to remove where the value is absent.
  std::vector<std::pair<std::string, std::optional<std::string>>> environment;
  bool has_input = true;             ///< if false, standard input is closed
  std::filesystem::path input = {};  ///< a file that is standard input
  Stream out = Stream::captured;
  Stream err = Stream::captured;
  std::optional<rlim_t> largest_file;   ///< bytes
  std::optional<rlim_t> address_space;  ///< bytes
  std::optional<rlim_t> stack;          ///< bytes
  /// Runs as the user nobody, whom permissions keep out, unlike the superuser.
  bool as_nobody = false;
  /// The signal that is sent when the command is at work.
  std::optional<Signal> signal;
  /// The signal is not sent if the command has ended before.
  std::optional<Kill> kill;
  /// After this the command is killed, and the test fails.
  std::chrono::seconds limit{120};
};

struct CommandResult {
  int exit_code = -1;  ///< -1 if the command was ended by a signal
  int signal = 0;      ///< the signal that ended the command
  bool is_timed_out = false;
  long peak_resident_bytes = 0;
  std::string out;
  std::string err;
};

/// The exit code of a child process that could not start the command.
inline constexpr int cannot_start = 126;

CommandResult run_command(const std::vector<std::string>& arguments, const CommandOptions& options);

}  // namespace hamjet::test
