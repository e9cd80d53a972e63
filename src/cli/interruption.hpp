#pragma once

#include <exception>

namespace hamjet::cli {

/// Thrown out of the work after SIGINT or SIGTERM.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  const char* what() const noexcept override { return "interrupted"; }
  /// 128 + the signal: 130 or 143.
  int exit_code() const noexcept { return 128 + signal_; }

 private:
  int signal_;
};

/// Catches SIGINT and SIGTERM from now on: the first asks the work to stop, a second one of the same
/// kind ends the program at once. SIGPIPE and SIGXFSZ become errors of the write.
void catch_signals();

/// Throws Interrupted if a signal has come.
void stop_if_interrupted();

}  // namespace hamjet::cli
