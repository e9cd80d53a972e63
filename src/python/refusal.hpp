#pragma once

#include <string>

#include "hamjet/error.hpp"

namespace hamjet::python {

/// Throws what is wrong with an argument.
[[noreturn]] inline void refuse(const std::string& problem) {
  throw Error(ErrorKind::usage, problem);
}

}  // namespace hamjet::python
