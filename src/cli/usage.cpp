#include "usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../scene/tables/key_reference.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {
namespace {

/// The nearest long option of a command, or of the program where there is none, as a suggestion.
std::string option_suggestion(const CLI::App& command, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string_view name = word.substr(0, word.find('='));
  return io::suggestion(name, {names.begin(), names.end()});
}

std::string unknown_command(const CLI::App& app, std::string_view word) {
  std::vector<std::string_view> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) == names.end() && word.ends_with(".toml")) {
    return fmt::format("{} stands where a command belongs, for example: hamjet run {}",
                       io::printable(word), io::printable(word));
  }
  return fmt::format("unknown command {}; {}", io::printable(word), io::suggestion(word, names));
}

/// The problem, and where more is said.
std::string with_reference(const std::string& problem) {
  return problem + (problem.ends_with("?") ? " See hamjet --help" : "; see hamjet --help");
}

}  // namespace

std::string help_text(const CLI::App& app, const std::optional<std::string>& command) {
  for (const CLI::App* child : app.get_subcommands({})) {
    if (child->get_name() == command) return child->help(app.get_name());
  }
  if (command) {
    if (const auto keys = io::section_on_keys(*command)) return *keys;
    throw Error(ErrorKind::usage, with_reference(unknown_command(app, *command)));
  }
  // App::help would be that of the command which asks.
  return app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const auto commands = app.get_subcommands();
  std::vector<std::string> unknown = app.remaining(true);
  // Behind "--", the end of options, no word is an option.
  const auto end = std::find(unknown.begin(), unknown.end(), "--");
  // An unknown option is named first: the words around it may only look wrong because of it.
  const auto first_option = std::find_if(
      unknown.begin(), end, [](const std::string& word) { return word.starts_with("-"); });
  std::optional<std::string> option;
  if (first_option != end) option = *first_option;
  if (end != unknown.end()) unknown.erase(end);
  std::string problem = io::printable(error.what(), 200);
  if (option) {
    problem = fmt::format("unknown option {}; {}", io::printable(*option),
                          option_suggestion(commands.empty() ? app : *commands[0], *option));
  } else if (!unknown.empty() && commands.empty()) {
    problem = unknown_command(app, unknown[0]);
  } else if (!unknown.empty() && unknown[0].ends_with(".toml") &&
             error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError)) {
    problem =
        fmt::format("{} stands before the command, must be: hamjet {} {}",
                    io::printable(unknown[0]), commands[0]->get_name(), io::printable(unknown[0]));
  } else if (!unknown.empty()) {
    problem = fmt::format("unexpected argument {}", io::printable(unknown[0]));
  }
  return with_reference(problem);
}

}  // namespace hamjet::cli
