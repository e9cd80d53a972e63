#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hamjet::cli {

/// What is wrong with the command line, on one line, with the nearest option or command for a word
/// that is none.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace hamjet::cli
