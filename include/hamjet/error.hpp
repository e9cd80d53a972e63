#pragma once

#include <stdexcept>
#include <string>

namespace hamjet {

/// What went wrong, numbered as the command's exit code.
enum class ErrorKind {
  check_failed = 1,  ///< a check that the scene asked for failed
  usage = 2,         ///< the command line, or a call of the library, is wrong
  scene = 3,         ///< the scene is wrong
  numerical = 4,  ///< no solution, no convergence, a singular matrix, a number that is not finite
  input_output = 5,  ///< a file could not be read or written
  too_large = 6,     ///< the work asked for does not fit this machine
};

/// The one exception type that hamjet throws on purpose; `what()` is one line for the
/// user, or a line for each mistake of a scene.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

  ErrorKind kind() const noexcept { return kind_; }
  int exit_code() const noexcept { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

}  // namespace hamjet
