#include "completion.hpp"

#include "../process/standard_streams.hpp"

namespace hamjet::cli {
namespace {

/// A shell that command lines can be completed in.
struct Shell {
  const char* name;
  const char* file;  ///< where it looks for a user's own completion
  std::string (*script)(const std::vector<CompletionCommand>&);
};

constexpr Shell shells[] = {
    {"bash", "~/.local/share/bash-completion/completions/hamjet", bash_completion},
    {"zsh", "a folder of $fpath, as _hamjet", zsh_completion},
    {"fish", "~/.config/fish/completions/hamjet.fish", fish_completion}};

}  // namespace

CLI::App* add_completion_command(CLI::App& app, std::string& shell) {
  std::string help = "where the script belongs:";
  std::vector<std::string> names;
  for (const Shell& known : shells) {
    names.emplace_back(known.name);
    help += std::string(names.size() > 1 ? ";" : "") + " of " + known.name + " " + known.file;
  }
  CLI::App* command = app.add_subcommand(
      "completion",
      "print a script with which a shell completes command lines\n"
      "Example: hamjet completion bash > ~/.local/share/bash-completion/completions/hamjet");
  command->add_option("shell", shell, help)->required()->check(CLI::IsMember(names));
  return command;
}

int completion(const CLI::App& app, const std::string& shell) {
  const auto commands = completion_commands(app);
  for (const Shell& known : shells) {
    if (shell == known.name) print(known.script(commands));
  }
  return 0;
}

}  // namespace hamjet::cli
