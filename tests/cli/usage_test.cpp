#include "command_test.hpp"

// What the command says about itself, and about command lines that are wrong.

namespace hamjet::test {
namespace {

using Usage = CommandTest;

TEST_F(Usage, HelpBeginsWithExamples) {
  const CommandResult result = succeed({"--help"});
  EXPECT_EQ(result.out.rfind("Examples:\n  hamjet init", 0), 0U) << result.out;
  for (const char* word :
       {"hamjet run scene.toml", "Exit codes", "Usage: hamjet", "check", "list"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word;
  }
}

TEST_F(Usage, EveryCommandHasHelp) {
  const std::string summary = succeed({"--help"}).out;
  EXPECT_EQ(succeed({"help"}).out, summary);
  std::istringstream lines(summary.substr(summary.find("\nSubcommands:\n") + 14));
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 3 || line[2] == ' ') continue;
    ++count;
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    const CommandResult result = succeed({command, "--help"});
    EXPECT_EQ(succeed({"help", command}).out, result.out);
    EXPECT_NE(result.out.find(std::string("Usage: hamjet ") + command), std::string::npos)
        << result.out;
  }
  EXPECT_GE(count, 15) << summary;
  const std::string run = succeed({"run", "--help"}).out;
  for (const char* option : {"--output", "--set", "--json", "--quiet"}) {
    EXPECT_NE(run.find(option), std::string::npos) << option;
  }
  EXPECT_NE(in_one_line(run).find("key=null removes it"), std::string::npos) << run;
}

TEST_F(Usage, NoLineOfAHelpOrListIsBeyondAHundredCharacters) {
  const std::string help = succeed({"--help"}).out;
  EXPECT_LE(widest_line(help), 100U);
  std::istringstream lines(help.substr(help.find("\nSubcommands:\n") + 14));
  std::size_t commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 3 || line[2] == ' ') continue;
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    const std::string text = succeed({command, "--help"}).out;
    EXPECT_LE(widest_line(text), 100U) << text;
    ++commands;
  }
  EXPECT_GE(commands, 13U);
  for (const char* what : {"systems", "integrators", "kinds"}) {
    EXPECT_LE(widest_line(succeed({"list", what}).out), 80U) << what;
  }
}

TEST_F(Usage, Version) {
  const std::string version = succeed({"--version"}).out;
  EXPECT_EQ(version.rfind("hamjet ", 0), 0U);
  const std::string summary = succeed({"run", "quick.toml", "--json"}).out;
  EXPECT_EQ(version, "hamjet " + Json::parse(summary)["version"].get<std::string>() + "\n");
}

TEST_F(Usage, Lists) {
  const std::string systems = succeed({"list", "systems"}).out;
  for (const char* name : {"zonal-gravity", "kepler", "harmonic-oscillator"}) {
    EXPECT_NE(systems.find(name), std::string::npos) << name;
  }
  const std::string integrators = succeed({"list", "integrators"}).out;
  for (const char* name : {"gauss ", "fehlberg78", "cvode-adams", "cvode-bdf"}) {
    EXPECT_NE(integrators.find(name), std::string::npos) << name;
  }
  const std::string kinds = succeed({"list", "kinds"}).out;
  // 2^3 x 2^3 kinds for three degrees of freedom, each with one hyphen between q's and p's.
  int count = 0;
  for (std::size_t i = 3; i + 3 < kinds.size(); ++i) {
    const auto is_choice = [](char c) { return c == 'q' || c == 'p'; };
    if (kinds[i] == '-' && is_choice(kinds[i - 1]) && is_choice(kinds[i + 1])) ++count;
  }
  EXPECT_EQ(count, 64);
}

// Everything, in the order in which the topics are named, each below a heading.
TEST_F(Usage, AListOfEverything) {
  const std::string all = succeed({"list"}).out;
  std::size_t at = 0;
  for (const char* topic : {"systems", "integrators", "kinds", "keys", "columns"}) {
    const std::string text = succeed({"list", topic}).out;
    const std::size_t found = all.find(text, at);
    ASSERT_NE(found, std::string::npos) << topic;
    EXPECT_EQ(all.substr(at, 2), "# ");
    at = found + text.size() + 1;
  }
  EXPECT_EQ(at, all.size() + 1);
}

// Where each command writes by itself, as its help says, is where it does.
TEST_F(Usage, HelpSaysWhereResultsGo) {
  const std::string formation = quick_scene() +
                                "[transfer]\nframe = \"RTN\"\ntimes_canonical = [0.5]\n"
                                "start = {position_m = [0, -10, 0]}\n"
                                "end = {position_m = [0, -5, 0]}\n"
                                "[validity]\ntolerance_m = 1\ntimes_canonical = [0.5]\n"
                                "[assignment]\ndeputy = [{position_m = [0, -10, 0]}]\n"
                                "slot = [{position_m = [0, 10, 0]}]\n";
  write("two.toml", formation);
  for (const char* command : {"run", "transfer", "validity", "assign"}) {
    const std::string help = unwrapped(succeed({command, "--help"}).out);
    const std::size_t begin = help.find("(default: out/<scene name>") + 10;
    const std::string folder = help.substr(begin, help.find(')', begin) - begin);
    succeed({command, "two.toml", "-q"});
    const auto results = directory_ / changed(folder, "<scene name>", "two");
    EXPECT_TRUE(std::filesystem::exists(results / "summary.json")) << results << help;
  }
}

TEST_F(Usage, CheckSaysWhatWouldBeComputed) {
  const auto before = files();
  const std::string text = succeed({"check", "small.toml", "--set", "jet.order=3"}).out;
  for (const char* word : {"small.toml: the scene is good", "order 3 in 6 variables",
                           "84 coefficients", "memory", "gauss8: gauss, 8 stages", "midpoint"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  }
  EXPECT_EQ(files(), before);
  expect_error({"check", "small.toml", "--set", "jet.ordre=3"}, 3, {"did you mean order?"});
  expect_error({"check", "missing.toml"}, 5, {"missing.toml", "No such file"});
}

TEST_F(Usage, NoArgumentsPrintTheUsage) {
  const CommandResult result = hamjet({});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("Usage: hamjet"), std::string::npos) << result.err;
}

// As POSIX has it: what follows -- is no option.
TEST_F(Usage, TwoHyphensEndTheOptions) {
  write("-small.toml", content(directory_ / "small.toml"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"check", "--", "-small.toml"},
        {"--", "check", "small.toml"},
        {"--", "check", "--set", "jet.order=2", "--", "-small.toml"}}) {
    EXPECT_NE(succeed(arguments).out.find("small.toml: the scene is good"), std::string::npos);
  }
  expect_error({"check", "--", "small.toml", "--set"}, 2, {"unexpected argument --set;"});
  expect_error({"--", "chekc", "small.toml"}, 2, {"unknown command chekc; did you mean check?"});
  EXPECT_EQ(hamjet({"--"}).exit_code, 2);
}

TEST_F(Usage, MistakesOnTheCommandLine) {
  const struct {
    std::vector<std::string> arguments;
    std::vector<std::string> words;
  } mistakes[] = {
      {{"rnu", "small.toml"}, {"unknown command rnu", "did you mean run?"}},
      {{"--josn"}, {"unknown option --josn"}},
      {{"run", "small.toml", "--josn"}, {"unknown option --josn", "did you mean --json?"}},
      {{"run", "small.toml", "--outptu=x"}, {"--outptu=x", "did you mean --output?"}},
      {{"run", "small.toml", "other.toml"}, {"unexpected argument other.toml"}},
      {{"small.toml", "run"}, {"small.toml stands before the command", "hamjet run small.toml"}},
      {{"run"}, {"scene"}},
      {{"run", "small.toml", "-o"}, {"--output"}},
      {{"run", "small.toml", "-o", "a", "-o", "b"}, {"--output"}},
      {{"run", "small.toml", "--set"}, {"--set"}},
      {{"run", "small.toml", "--set", "order"}, {"--set order: must be key=value"}},
      {{"run", "small.toml", "--set", "=3"}, {"must be key=value"}},
      {{"run", "small.toml", "--set", "a\nb"}, {"a\\x0ab"}},
      {{"run", "small.toml", "--set", "system.J2="}, {"--set system.J2: empty"}},
      {{"run", "small.toml", "--set", "jet.ordre=null"},
       {"--set jet.ordre: nothing to remove, got no key \"ordre\"; did you mean order?"}},
      {{"run", "small.toml", "--set", "jet..order=3"}, {"--set jet..order", "empty name"}},
      {{"run", "small.toml", "--set", "title.x=3"}, {"--set title.x", "no such key"}},
      {{"run", "small.toml", "--set", "integrator.guass8.stages=3"}, {"guass8", "no such element"}},
      // An unset variable of a script must not mean the built-in scene, or the working directory.
      {{"run", ""}, {"scene: empty"}},
      {{"check", ""}, {"scene: empty"}},
      {{"run", "small.toml", "-o", ""}, {"--output: empty"}},
      {{"help", "rnu"}, {"unknown command rnu", "did you mean run?"}},
      {{"help", "run", "small.toml"}, {"unexpected argument small.toml"}},
      {{"list", "planets"}, {"planets", "systems", "integrators", "kinds"}},
      {{"demo", "small.toml"}, {"unexpected argument small.toml"}},
  };
  for (const auto& mistake : mistakes) expect_error(mistake.arguments, 2, mistake.words);
}

}  // namespace
}  // namespace hamjet::test
