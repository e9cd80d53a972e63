#include "completion_words.hpp"

namespace hamjet::cli {
namespace {

/// The words of an enumeration in braces, where the type has one: CLI11 writes it behind the type's
/// own name.
std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t brace = name.find('{');
  return brace == std::string::npos ? name : name.substr(brace, name.find('}') + 1 - brace);
}

CompletionOption described(const CLI::Option& option) {
  CompletionOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.type = type_of(option);
  return result;
}

CompletionCommand described(const CLI::App& command, const std::string& name) {
  CompletionCommand result{name, {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    (option->get_positional() ? result.positionals : result.options).push_back(described(*option));
  }
  return result;
}

}  // namespace

std::vector<CompletionCommand> completion_commands(const CLI::App& app) {
  std::vector<CompletionCommand> commands = {described(app, "")};
  for (const CLI::App* child : app.get_subcommands({})) {
    commands.push_back(described(*child, child->get_name()));
  }
  return commands;
}

}  // namespace hamjet::cli
