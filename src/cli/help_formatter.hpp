#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hamjet::cli {

/// Helps whose lines fit a terminal: descriptions are broken between words.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace hamjet::cli
