#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace hamjet::cli {

CLI::App* add_list_command(CLI::App& app, std::optional<std::string>& what);

/// Prints what scenes may name: of one topic, or of all under headings. Returns the exit code.
int list(const std::optional<std::string>& what);

}  // namespace hamjet::cli
