#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "completion_words.hpp"

namespace hamjet::cli {

// A script with which bash completes the program's command lines, from the description of its
// commands. What an argument is completed with follows from its type there:
//
//   {a,b}           one of these words, as CLI::IsMember says too
//   SCENE, SCENES   files *.toml and folders
//   FILE            files and folders
//   DIRECTORY       folders
//   LABEL           runs whose jets are in a folder that the command line names
//   COMMAND         the program's commands
//
// and with nothing for any other type.

std::string bash_completion(const std::vector<CompletionCommand>& commands);

CLI::App* add_completion_command(CLI::App& app, std::string& shell);

/// Prints the script; returns the exit code.
int completion(const CLI::App& app);

}  // namespace hamjet::cli
