#include "help_formatter.hpp"

#include <sstream>

#include "../text/terminal_text.hpp"

namespace hamjet::cli {
namespace {

/// The manual takes the first line of a command's description, which therefore may be longer.
constexpr std::size_t widest_line = 100;

}  // namespace

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return io::fitted(CLI::Formatter::make_option_desc(option),
                    io::terminal_width - get_column_width());
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream text;
  CLI::detail::format_help(text, command->get_display_name(true),
                           io::fitted(command->get_description(), widest_line - get_column_width()),
                           get_column_width());
  return text.str();
}

}  // namespace hamjet::cli
