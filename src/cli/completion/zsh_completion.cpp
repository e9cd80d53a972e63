#include <fmt/format.h>

#include <string_view>

#include "completion.hpp"

namespace hamjet::cli {
namespace {

/// The part of the script that does not depend on the commands; they stand before it.
constexpr const char* zsh_engine = R"(
# Runs whose jets are in a folder that the command line names.
_hamjet_runs() {
  local -a runs
  local word expl
  for word in $words; do runs+=(${(Q)word%/}/*/jet.csv(N:h:t)); done
  _wanted runs expl run compadd -a runs
}

if [[ $funcstack[1] == _hamjet ]]; then
  _hamjet "$@"
else
  compdef _hamjet hamjet
fi
)";

std::string with_backslashes(const std::string& text, std::string_view before) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || before.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// A word in quotes, in which all but the quote stands for itself.
std::string in_zsh_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// What completes an argument of this type, behind its name: ":name:action" of _arguments.
std::string zsh_argument(const std::string& type) {
  const auto words = words_of_type(type);
  if (!words.empty()) return fmt::format(":value:({})", fmt::join(words, " "));
  std::string action = " ";
  if (type == "SCENE" || type == "SCENES") action = "_files -g \"*.toml\"";
  if (type == "FILE") action = "_files";
  if (type == "DIRECTORY") action = "_files -/";
  if (type == "LABEL") action = "_hamjet_runs";
  if (type == "COMMAND") action = "_hamjet_commands";
  return fmt::format(":{}:{}", with_backslashes(type, ":"), action);
}

/// The words of _arguments for one option, one for each of its names, which exclude each other.
std::string option_words(const CompletionOption& option) {
  const std::string head =
      option.is_repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
  std::string text;
  for (const std::string& name : option.names) {
    std::string word = head + name;
    if (!option.type.empty()) word += name.starts_with("--") ? "=" : "+";
    word += fmt::format("[{}]", with_backslashes(option.help, "[]:"));
    if (!option.type.empty()) word += zsh_argument(option.type);
    text += fmt::format(" \\\n        {}", in_zsh_quotes(word));
  }
  return text;
}

/// The call of _arguments for one command, or for the program with what begins its commands'.
std::string call_of_arguments(const CompletionCommand& command) {
  std::string text = fmt::format("_arguments -S{}", command.name.empty() ? " -C" : "");
  for (const CompletionOption& option : command.options) text += option_words(option);
  for (const CompletionOption& option : command.positionals) {
    text += fmt::format(" \\\n        {}", in_zsh_quotes(zsh_argument(option.type)));
  }
  if (command.name.empty()) text += " \\\n        '1: :_hamjet_commands' '*:: :->command'";
  return text;
}

}  // namespace

std::string zsh_completion(const std::vector<CompletionCommand>& commands) {
  std::string names;
  std::string branches;
  for (const CompletionCommand& command : commands) {
    if (command.name.empty()) continue;
    branches +=
        fmt::format("    '{}')\n      {}\n      ;;\n", command.name, call_of_arguments(command));
    names += fmt::format("    {}\n",
                         in_zsh_quotes(command.name + ":" + with_backslashes(command.help, ":")));
  }
  // What _arguments leaves of the words lasts to the end of the function that calls it, so that
  // both calls stand in one.
  return fmt::format(
      "#compdef hamjet\n"
      "# Completion of hamjet's command lines for zsh, written by `hamjet completion zsh`.\n\n"
      "_hamjet_commands() {{\n  local -a commands=(\n{}  )\n  _describe command commands\n}}\n\n"
      "_hamjet() {{\n  local curcontext=$curcontext context state state_descr line\n"
      "  typeset -A opt_args\n  {}\n  [[ $state == command ]] || return\n  case $words[1] in\n"
      "{}  esac\n}}\n{}",
      names, call_of_arguments(commands.front()), branches, zsh_engine);
}

}  // namespace hamjet::cli
