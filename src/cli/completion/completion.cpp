#include "completion.hpp"

#include "../process/standard_streams.hpp"

namespace hamjet::cli {
CLI::App* add_completion_command(CLI::App& app, std::string& shell) {
  CLI::App* command = app.add_subcommand(
      "completion",
      "print a script with which a shell completes command lines\n"
      "Example: hamjet completion bash > ~/.local/share/bash-completion/completions/hamjet");
  command->add_option("shell", shell, "the shell")->required()->check(CLI::IsMember({"bash"}));
  return command;
}

int completion(const CLI::App& app) {
  print(bash_completion(completion_commands(app)));
  return 0;
}

}  // namespace hamjet::cli
