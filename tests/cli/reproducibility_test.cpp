#include <sched.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>

#include "command_test.hpp"

// The same scene on the same machine gives the same bytes, whatever surrounds the command. What is
// excepted: measured times, the keys of summary.json that end with "seconds", and its own checksum
// "crc32", which is over them.
//
// The command computes in one thread; only the coarser of the two runs of a reference has a second
// one of its own, and the two share no numbers.

namespace hamjet::test {
namespace {

/// An orbit with everything that `hamjet run` writes: inversion, reference, relative Hamiltonian, a
/// figure (which gnuplot draws), integrators that choose their steps and others.
const std::string reproduced_scene = R"(schema = 1
title = "Erdnähe"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1.0826e-3
J3 = -2.5327e-6
)" + orbit_elements + R"([jet]
order = 2
duration_canonical = 2.5
)" + gauss8("tolerance = 1e-13") + R"([[integrator]]
label = "verlet"
method = "velocity-verlet"
order = 4
step_canonical = 0.05
[[integrator]]
label = "fehlberg"
method = "fehlberg78"
tolerance = 1e-10
[formation]
separation_km = 1.5
[generating_function]
kinds = ["F1", "auto"]
[reference]
[relative_hamiltonian]
times_canonical = [0.0, 1.25]
[figure]
quantity = "exactness"
kind = "F1"
)";

/// The text without the lines of measured times, and without the checksum of the whole.
std::string without_times(const std::string& json) {
  std::istringstream lines(json);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const bool is_checksum = line.starts_with("  \"crc32\": ");
    if (line.find("seconds\": ") == std::string::npos && !is_checksum) result += line + '\n';
  }
  return result;
}

using Files = std::map<std::string, std::string>;

class Reproducibility : public CommandTest {
 protected:
  Reproducibility() { write("scene.toml", reproduced_scene); }

  Files contents(const std::filesystem::path& results) const {
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().lexically_relative(results).string();
      files[name] = content(entry.path());
      if (name == "summary.json") files[name] = without_times(files[name]);
    }
    return files;
  }

  /// The results of the scene in the surroundings that `options` describe.
  Files results(CommandOptions options, const std::vector<std::string>& more = {"-q"}) const {
    const TemporaryDirectory output;
    std::filesystem::permissions(output.path(), std::filesystem::perms(0777));
    std::vector<std::string> arguments = {"run", (directory_ / "scene.toml").string(), "-o",
                                          (output.path() / "results").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_command(arguments, options);
    EXPECT_FALSE(result.is_timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    return result.exit_code == 0 ? contents(output.path() / "results") : Files();
  }

  Files results_with(
      const std::vector<std::pair<std::string, std::optional<std::string>>>& environment) const {
    CommandOptions options = options_;
    options.environment = environment;
    return results(options);
  }

  static void expect_same(const Files& expected, const Files& files, const std::string& about) {
    SCOPED_TRACE(about);
    // 3 runs of jet, nominal and two generating functions, and three files of the scene's own.
    EXPECT_GE(expected.size(), 3U * 4 + 3);
    for (const auto& [name, text] : expected) {
      const auto found = files.find(name);
      if (found == files.end()) {
        ADD_FAILURE() << name << " is missing";
      } else if (found->second != text) {
        const auto place =
            std::mismatch(text.begin(), text.end(), found->second.begin(), found->second.end())
                .first -
            text.begin();
        ADD_FAILURE() << name << " differs at byte " << place << ": "
                      << text.substr(static_cast<std::size_t>(place), 40);
      }
    }
    EXPECT_EQ(files.size(), expected.size());
  }
};

TEST_F(Reproducibility, TwiceTheSame) {
  const Files first = results(options_);
  EXPECT_NE(first.find("gauss8/jet.csv"), first.end());
  EXPECT_NE(first.find("summary.json"), first.end());
  EXPECT_NE(first.find("figure.svg"), first.end());
  expect_same(first, results(options_), "again");
}

TEST_F(Reproducibility, OtherDirectory) {
  const Files expected = results(options_);
  const TemporaryDirectory other;
  CommandOptions options = options_;
  options.directory = other.path();
  expect_same(expected, results(options), "another working directory");
  EXPECT_TRUE(std::filesystem::is_empty(other.path()));
  // The results are the same beside the scene too, with the paths that a user types.
  succeed({"run", "scene.toml", "-q", "-o", "results"});
  expect_same(expected, contents(directory_ / "results"), "relative paths");
}

TEST_F(Reproducibility, Terminal) {
  const Files expected = results(options_);
  CommandOptions options = options_;
  options.out = options.err = Stream::terminal;
  for (const char* const kind : {"", "dumb", "xterm-256color"}) {
    options.environment = {{"TERM", *kind != 0 ? std::optional<std::string>(kind) : std::nullopt},
                           {"COLUMNS", "20"}};
    expect_same(expected, results(options, {}), std::string("TERM ") + kind);
  }
  options.out = options.err = Stream::captured;
  expect_same(expected, results(options, {}), "no terminal, not quiet");
  options.err = Stream::full;
  expect_same(expected, results(options, {}), "nowhere to write progress to");
}

TEST_F(Reproducibility, Environment) {
  const Files expected = results(options_);
  expect_same(expected,
              results_with({{"TZ", std::nullopt},
                            {"HOME", std::nullopt},
                            {"USER", std::nullopt},
                            {"LANG", std::nullopt},
                            {"TMPDIR", std::nullopt}}),
              "without TZ, HOME, USER, LANG, TMPDIR");
  expect_same(expected, results_with({{"TZ", "Pacific/Kiritimati"}, {"HOME", "/nowhere"}}),
              "TZ, HOME");
  for (const char* const threads : {"1", "8"}) {
    expect_same(expected,
                results_with({{"OMP_NUM_THREADS", threads},
                              {"OPENBLAS_NUM_THREADS", threads},
                              {"MKL_NUM_THREADS", threads},
                              {"EIGEN_NUM_THREADS", threads}}),
                std::string("threads ") + threads);
  }
}

TEST_F(Reproducibility, NumberOfProcessors) {
  const Files expected = results(options_);
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  cpu_set_t one;
  CPU_ZERO(&one);
  for (int processor = 0; processor < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++processor) {
    if (CPU_ISSET(processor, &all)) CPU_SET(processor, &one);
  }
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  const Files alone = results(options_);
  ASSERT_EQ(::sched_setaffinity(0, sizeof all, &all), 0);
  expect_same(expected, alone, "one processor");
}

// In this locale every program that asks the C library writes 1.5 as 1,5.
TEST_F(Reproducibility, LocaleWithADecimalComma) {
  const Files expected = results(options_);
  const std::filesystem::path locales = directory_ / "locales";
  std::filesystem::create_directory(locales);
  const std::string command =
      "localedef -i de_DE -f UTF-8 '" + (locales / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status) || WEXITSTATUS(status) > 1) {  // 1: made, with warnings
    GTEST_SKIP() << "no locale with a decimal comma can be made: localedef or the definition de_DE "
                    "is missing (the package locales)";
  }
  // A program that asks the C library for its decimal point shows that the locale is in force.
  const std::string asked =
      "test \"$(LC_ALL=de_DE.UTF-8 LOCPATH='" + locales.string() + "' locale decimal_point)\" = ,";
  ASSERT_EQ(std::system(asked.c_str()), 0);
  expect_same(expected,
              results_with({{"LOCPATH", locales.string()},
                            {"LC_ALL", "de_DE.UTF-8"},
                            {"LANG", "de_DE.UTF-8"},
                            {"LC_NUMERIC", "de_DE.UTF-8"}}),
              "a decimal comma");
  expect_same(expected, results_with({{"LC_ALL", "no_SUCH.locale"}}), "a locale that is not there");
}

TEST_F(Reproducibility, DirectoryThatMayNotBeWritten) {
  const Files expected = results(options_);
  CommandOptions options = options_;
  options.as_nobody = ::geteuid() == 0;
  std::filesystem::permissions(directory_, std::filesystem::perms(0755));
  if (run_command({"--version"}, options).exit_code == cannot_start) {
    GTEST_SKIP() << "the command cannot be run by another user here";
  }
  std::filesystem::permissions(directory_, std::filesystem::perms(0555));
  expect_same(expected, results(options), "a working directory that may not be written");
  std::filesystem::permissions(directory_, std::filesystem::perms(0755));
}

}  // namespace
}  // namespace hamjet::test
