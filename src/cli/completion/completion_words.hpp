#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hamjet::cli {

/// An option or a positional as a completion sees it.
struct CompletionOption {
  std::vector<std::string> names;  ///< with their hyphens; none of a positional
  std::string type;                ///< see completion.hpp; empty for a flag
};

/// A command, or the program itself, whose name is empty.
struct CompletionCommand {
  std::string name;
  std::vector<CompletionOption> options;
  std::vector<CompletionOption> positionals;
};

/// The program and then its commands, from their description for --help.
std::vector<CompletionCommand> completion_commands(const CLI::App& app);

}  // namespace hamjet::cli
