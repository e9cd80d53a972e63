#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace hamjet::cli {

/// Adds `-o,--output` to a command. What is written is a file or a folder with a name: `-`, which
/// elsewhere means standard output, is refused, and `instead` says what is right.
inline void add_output_option(CLI::App& command, std::optional<std::string>& output,
                              const std::string& description, const std::string& type,
                              const std::string& instead) {
  command.add_option("-o,--output", output, description)
      ->type_name(type)
      ->check([instead](const std::string& name) {
        return name == "-" ? "got -, " + instead + "; ./- is what has that name" : std::string();
      });
}

}  // namespace hamjet::cli
