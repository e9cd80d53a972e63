#include <fmt/format.h>

#include "completion.hpp"

namespace hamjet::cli {
namespace {

/// The part of the script that does not depend on the commands; they follow it. fish runs
/// conditions and lists of words while the line is typed.
constexpr const char* fish_engine =
    R"(# Completion of hamjet's command lines for fish, written by `hamjet completion fish`.

# Whether the command of the line is this one; the empty word stands for none yet.
function __hamjet_is -a command
    for word in (commandline -opc)[2..]
        string match -q -- '-*' $word; and continue
        test "$word" = "$command"
        return
    end
    test -z "$command"
end

# Scenes, and folders that may hold some.
function __hamjet_scenes
    set -l begin (commandline -ct | string replace -r '^-[^=]*=' '')
    for file in $begin*
        if test -d $file
            echo $file/
        else if string match -q -- '*.toml' $file
            echo $file
        end
    end
end

# Runs whose jets are in a folder that the command line names.
function __hamjet_runs
    for word in (commandline -opc)[2..]
        for jet in (string trim -r -c / -- $word)/*/jet.csv
            basename (dirname $jet)
        end
    end
end

complete -c hamjet -f
)";

/// A word in quotes.
std::string in_fish_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

/// What completes an argument of this type, as options of `complete`; `commands` is the list of
/// all.
std::string fish_argument(const std::string& type, const std::string& commands) {
  const auto list = [](const std::string& words) { return " -a " + in_fish_quotes(words); };
  const auto words = words_of_type(type);
  if (!words.empty()) return list(fmt::format("{}", fmt::join(words, " ")));
  if (type == "SCENE" || type == "SCENES") return list("(__hamjet_scenes)");
  if (type == "FILE") return " -F";
  if (type == "DIRECTORY") return list("(__fish_complete_directories)");
  if (type == "LABEL") return list("(__hamjet_runs)");
  if (type == "COMMAND") return list(commands);
  return "";
}

std::string option_line(const std::string& condition, const CompletionOption& option,
                        const std::string& commands) {
  std::string line = condition;
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.type.empty()) {
    line += (option.type == "FILE" ? " -r" : " -x") + fish_argument(option.type, commands);
  }
  return fmt::format("{} -d {}\n", line, in_fish_quotes(option.help));
}

}  // namespace

std::string fish_completion(const std::vector<CompletionCommand>& commands) {
  std::string names;
  std::string lines;
  for (const CompletionCommand& command : commands) {
    if (command.name.empty()) continue;
    names += (names.empty() ? "" : " ") + command.name;
    lines += fmt::format("complete -c hamjet -n '__hamjet_is \"\"' -a {} -d {}\n", command.name,
                         in_fish_quotes(command.help));
  }
  for (const CompletionCommand& command : commands) {
    const std::string condition =
        fmt::format("complete -c hamjet -n {}",
                    in_fish_quotes(fmt::format("__hamjet_is \"{}\"", command.name)));
    for (const CompletionOption& option : command.options) {
      lines += option_line(condition, option, names);
    }
    for (const CompletionOption& option : command.positionals) {
      lines += condition + fish_argument(option.type, names) + "\n";
    }
  }
  return fish_engine + lines;
}

}  // namespace hamjet::cli
