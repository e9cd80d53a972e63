#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace hamjet::cli {

struct InitOptions {
  std::string program = "hamjet";      ///< as it was called, in quotes where a shell needs them
  std::optional<std::string> kind;     ///< one of those that the command's help names
  std::optional<std::string> message;  ///< an orbit message to start from, in place of a kind
  std::optional<std::string> output;   ///< absent: named after the kind or the message, here
};

CLI::App* add_init_command(CLI::App& app, InitOptions& options);

/// Writes a commented scene that runs as it is, where no file is yet, and says what to do with it.
/// Returns the exit code.
int init(const InitOptions& options);

}  // namespace hamjet::cli
