#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hamjet::cli {

/// A script for bash that completes the program's command lines, from the description of its
/// commands. What an argument is completed with follows from its type there:
///
///   {a,b}           one of these words, as CLI::IsMember says too
///   SCENE, SCENES   files *.toml and folders
///   FILE            files and folders
///   DIRECTORY       folders
///   LABEL           runs whose jets are in a folder that the command line names
///
/// and with nothing for any other type.
std::string bash_completion(const CLI::App& app);

}  // namespace hamjet::cli
