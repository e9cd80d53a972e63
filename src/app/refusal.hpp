#pragma once

#include <string>

#include "hamjet/error.hpp"

namespace hamjet::cli {

/// Throws what is wrong with the command line.
[[noreturn]] inline void refuse(const std::string& problem) {
  throw Error(ErrorKind::usage, problem);
}

}  // namespace hamjet::cli
