#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace hamjet::cli {

/// Who has given an argument, and so knows it by another name: `--frame RTN` of the command is
/// `frame='RTN'` of the Python module.
enum class Caller { command, module };

/// The name of an argument, for messages.
inline std::string argument(Caller caller, std::string_view name) {
  return fmt::format("{}{}", caller == Caller::command ? "--" : "", name);
}

/// The argument with its value.
inline std::string argument(Caller caller, std::string_view name, std::string_view value) {
  return caller == Caller::command ? fmt::format("--{} {}", name, value)
                                   : fmt::format("{}='{}'", name, value);
}

}  // namespace hamjet::cli
