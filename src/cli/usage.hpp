#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace hamjet::cli {

/// What `--help` prints of the command of this name, or of the program without one. Throws
/// Error(usage) for a name that is none.
std::string help_text(const CLI::App& app, const std::optional<std::string>& command);

/// What is wrong with the command line, on one line, with the nearest option or command for a word
/// that is none.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace hamjet::cli
