#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "hamjet/error.hpp"

namespace hamjet::cli {

/// Throws what is wrong with the command line.
[[noreturn]] inline void refuse(const std::string& problem) {
  throw Error(ErrorKind::usage, problem);
}

/// Refuses an empty name: it comes from an unset variable of a script, and must not mean something
/// else.
inline void refuse_empty(const std::optional<std::string>& value, const char* option,
                         const char* what) {
  if (value && value->empty()) refuse(fmt::format("{}: empty, must name {}", option, what));
}

}  // namespace hamjet::cli
