#include "bash_completion.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace hamjet::cli {
namespace {

/// The part of the script that does not depend on the commands. `describe COMMAND` sets `commands`,
/// `options` and `positionals` (their types); `type_of COMMAND OPTION` sets `type`, which stays
/// empty for a flag.
constexpr const char* engine = R"(
# Words that begin with $current for an argument of this type.
_hamjet_complete_type() {
  local folder runs=
  case $1 in
    '{'*'}') mapfile -t COMPREPLY < <(compgen -W "${1//[\{,\}]/ }" -- "$current") ;;
    SCENE | SCENES)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.toml' -- "$current")
      ;;
    FILE)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$current")
      ;;
    DIRECTORY)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$current")
      ;;
    LABEL)
      for folder in "${words[@]}"; do
        for folder in "${folder%/}"/*/jet.csv; do
          [[ -e $folder ]] || continue
          folder=${folder%/jet.csv}
          runs+="${folder##*/} "
        done
      done
      mapfile -t COMPREPLY < <(compgen -W "$runs" -- "$current")
      ;;
  esac
}

_hamjet() {
  local commands options positionals type command= current= pending= count=0 i word
  local words=() # with --option=value in one piece, which bash cuts at the equals sign
  for ((i = 1; i <= COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == = || ${COMP_WORDS[i - 1]} == = ]] && ((${#words[@]} > 0)); then
      words[-1]+=$word
    else
      words+=("$word")
    fi
  done
  COMPREPLY=()
  _hamjet_describe ''
  for word in "${words[@]:0:${#words[@]}-1}"; do
    type=
    if [[ $pending ]]; then
      pending=
    elif [[ $word == -*=* ]]; then
      :
    elif [[ $word == -* ]]; then
      _hamjet_type_of "$command" "$word"
      pending=$type
    elif [[ ! $command ]]; then
      command=$word
      _hamjet_describe "$command"
    else
      ((++count))
    fi
  done
  current=${words[-1]}
  if [[ $pending ]]; then
    _hamjet_complete_type "$pending"
  elif [[ $current == -*=* ]]; then
    type=
    _hamjet_type_of "$command" "${current%%=*}"
    current=${current#*=}
    _hamjet_complete_type "$type"
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  elif [[ ! $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  else
    positionals=($positionals)
    _hamjet_complete_type "${positionals[count]-}"
  fi
}
complete -F _hamjet hamjet
)";

/// The words of an enumeration in braces, where the type has one: CLI11 writes it behind the type's
/// own name.
std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t brace = name.find('{');
  return brace == std::string::npos ? name : name.substr(brace, name.find('}') + 1 - brace);
}

std::vector<std::string> names(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// The branch of `_hamjet_describe` for one command; the program itself has no name.
std::string description_branch(const CLI::App& command, const std::string& name) {
  std::vector<std::string> commands;
  for (const CLI::App* child : command.get_subcommands({})) commands.push_back(child->get_name());
  std::vector<std::string> options;
  std::vector<std::string> positionals;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) positionals.push_back(type_of(*option));
    for (const std::string& option_name : names(*option)) options.push_back(option_name);
  }
  return fmt::format("    '{}') commands='{}' options='{}' positionals='{}' ;;\n", name,
                     joined(commands, " "), joined(options, " "), joined(positionals, " "));
}

/// The branches of `_hamjet_type_of` for one command.
std::string type_branches(const CLI::App& command, const std::string& name) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = type_of(*option);
    if (option->get_positional() || type.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& option_name : names(*option)) {
      patterns.push_back(fmt::format("'{} {}'", name, option_name));
    }
    text += fmt::format("    {}) type='{}' ;;\n", joined(patterns, " | "), type);
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string descriptions = description_branch(app, "");
  std::string types = type_branches(app, "");
  for (const CLI::App* command : app.get_subcommands({})) {
    descriptions += description_branch(*command, command->get_name());
    types += type_branches(*command, command->get_name());
  }
  return fmt::format(
      "# Completion of hamjet's command lines for bash, written by `hamjet completion bash`.\n\n"
      "_hamjet_describe() {{\n  case $1 in\n{}    *) commands= options= positionals= ;;\n"
      "  esac\n}}\n\n_hamjet_type_of() {{\n  case \"$1 $2\" in\n{}  esac\n}}\n{}",
      descriptions, types, engine);
}

}  // namespace hamjet::cli
