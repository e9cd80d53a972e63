#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "completion.hpp"

namespace hamjet::cli {
namespace {

/// The part of the script that does not depend on the commands. `describe COMMAND` sets `commands`,
/// `options` and `positionals` (their types); `type_of COMMAND OPTION` sets `type`, which stays
/// empty for a flag.
constexpr const char* bash_engine = R"(
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
    COMMAND)
      _hamjet_describe ''
      mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
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

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// The branch of `_hamjet_describe` for one command.
std::string description_branch(const CompletionCommand& command, const std::string& commands) {
  std::vector<std::string> options;
  std::vector<std::string> positionals;
  for (const CompletionOption& option : command.options) {
    options.insert(options.end(), option.names.begin(), option.names.end());
  }
  for (const CompletionOption& option : command.positionals) positionals.push_back(option.type);
  return fmt::format("    '{}') commands='{}' options='{}' positionals='{}' ;;\n", command.name,
                     commands, joined(options, " "), joined(positionals, " "));
}

/// The branches of `_hamjet_type_of` for one command.
std::string type_branches(const CompletionCommand& command) {
  std::string text;
  for (const CompletionOption& option : command.options) {
    if (option.type.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) {
      patterns.push_back(fmt::format("'{} {}'", command.name, name));
    }
    text += fmt::format("    {}) type='{}' ;;\n", joined(patterns, " | "), option.type);
  }
  return text;
}

}  // namespace

std::string bash_completion(const std::vector<CompletionCommand>& commands) {
  std::vector<std::string> names;
  for (const CompletionCommand& command : commands) {
    if (!command.name.empty()) names.push_back(command.name);
  }
  std::string descriptions;
  std::string types;
  for (const CompletionCommand& command : commands) {
    descriptions += description_branch(command, command.name.empty() ? joined(names, " ") : "");
    types += type_branches(command);
  }
  return fmt::format(
      "# Completion of hamjet's command lines for bash, written by `hamjet completion bash`.\n\n"
      "_hamjet_describe() {{\n  case $1 in\n{}    *) commands= options= positionals= ;;\n"
      "  esac\n}}\n\n_hamjet_type_of() {{\n  case \"$1 $2\" in\n{}  esac\n}}\n{}",
      descriptions, types, bash_engine);
}

}  // namespace hamjet::cli
