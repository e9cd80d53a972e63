#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <random>

#include "two_results.hpp"

// SIGKILL at random moments, which no program can catch. Whatever a later hamjet reads must be
// whole and the same as without the kills, and nothing that was complete may be lost. HAMJET_KILLS
// sets the number of kills (tools/kill-test: 1000).

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

class KillTest : public TwoResults {
 protected:
  static int kills() {
    const char* text = std::getenv("HAMJET_KILLS");
    return text == nullptr ? 20 : std::atoi(text);
  }

  microseconds random_time(microseconds longest) {
    return microseconds(std::uniform_int_distribution<std::int64_t>(0, longest.count())(random_));
  }

  /// The duration of the command, or the time until it makes `path`, at which it is killed. The
  /// median of a few runs.
  microseconds measure(const std::vector<std::string>& arguments, const fs::path& path = {}) {
    std::vector<microseconds> times;
    for (int i = 0; i < 5; ++i) {
      if (!path.empty()) fs::remove_all(path);
      CommandOptions options = options_;
      if (!path.empty()) options.kill = Kill{microseconds(0), path};
      const auto start = Clock::now();
      run_command(arguments, options);
      times.push_back(std::chrono::duration_cast<microseconds>(Clock::now() - start));
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }

  /// Runs the command and kills it: every other time at any moment of its time, else at any moment
  /// from when the results are being written.
  CommandResult run_and_kill(const std::vector<std::string>& arguments, const fs::path& output,
                             int number) {
    const bool is_writing = number % 2 == 1;
    // A file left by the previous run would exist too early.
    if (is_writing) fs::remove_all(output / ".hamjet-new");
    CommandOptions options = options_;
    options.kill = Kill{random_time(is_writing ? writing_time_ : whole_time_),
                        is_writing ? output / ".hamjet-new" : fs::path()};
    return run_command(arguments, options);
  }

  std::mt19937_64 random_{std::random_device{}()};
  microseconds whole_time_{0};
  microseconds writing_time_{0};
};

using KillRun = KillTest;

TEST_F(KillRun, LeavesTheOldOrTheNewResultsWhole) {
  make_results();
  whole_time_ = measure(command(0, results));
  const fs::path written = directory_ / results / ".hamjet-new";
  writing_time_ = std::max(whole_time_ - measure(command(0, results), written), microseconds(500));
  int present = found();
  int count_old = 0;
  int count_new = 0;
  int count_ended = 0;
  int count_completed = 0;
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    const CommandResult result =
        run_and_kill(command(1 - present, results), directory_ / results, i);
    count_ended += result.signal == SIGKILL ? 0 : 1;
    count_completed += fs::exists(directory_ / results / ".hamjet-ready") ? 1 : 0;
    const int now = found();
    if (result.signal == SIGKILL) ++(now == present ? count_old : count_new);
    present = now;
  }
  // A run that is not killed removes what the others left.
  succeed(command(1 - present, results));
  for (const auto& entry : fs::directory_iterator(directory_ / results)) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".hamjet-")) << entry.path();
  }
  found();
  fmt::print(
      "hamjet run ({:.1f} ms, writing {:.1f} ms): {} moments, {} killed: the old results {}, the "
      "new {}, of which {} were put in place by the next command; {} had ended before. Incomplete "
      "or wrong: {}\n",
      static_cast<double>(whole_time_.count()) / 1e3,
      static_cast<double>(writing_time_.count()) / 1e3, kills(), count_old + count_new, count_old,
      count_new, count_completed, count_ended, HasFailure() ? "see above" : "0");
}

/// One degree of freedom, so that a comparison takes a fraction of a second.
const std::string compared_oscillator = R"(schema = 1
title = "oscillator"
)" + oscillator_tables + R"([jet]
order = 1
duration_canonical = 1
[[integrator]]
label = "gauss8"
method = "gauss"
tolerance = 1e-13
[formation]
separation_m = 0.01
[generating_function]
kinds = ["F1"]
[reference]
[compare]
methods = ["gauss", "fehlberg78"]
stages = [1, 2, 4, 8]
steps_canonical = [0.4, 0.05, 0.001]
tolerances = [1e-5, 1e-8]
orders = [1]
repeats = 1
time_budget_s = 1000
)";

class KillComparison : public KillTest {
 protected:
  KillComparison() {
    write("oscillator.toml", compared_oscillator);
    // The run is without gnuplot, which would take most of the time.
    options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()},
                            {"PATH", "/nowhere"}};
  }

  static std::vector<std::string> comparison(const std::string& directory, bool resume = false) {
    std::vector<std::string> arguments = {"compare", "oscillator.toml", "-q", "-o", directory};
    if (resume) arguments.emplace_back("--resume");
    return arguments;
  }

  /// The numbers of a comparison, without times.
  Json figures(const std::string& directory) const {
    const Json json = read_json(directory_ / directory / "compare.json");
    EXPECT_EQ(json["complete"], true);
    Json result = {{"along_time", json["along_time"]}, {"kind", json["kind"]}};
    for (const char* list : {"runs", "cost_runs"}) {
      for (const Json& run : json[list]) {
        Json kept;
        for (const char* key :
             {"settings", "order", "failure", "left_out", "error_by_degree", "error_at_formation_m",
              "exactness", "symplecticity", "energy_error", "corner", "multiply_adds"}) {
          kept[key] = run.at(key);
        }
        result[list].push_back(std::move(kept));
      }
    }
    return result;
  }
};

TEST_F(KillComparison, IsTakenUpWithTheSameFigures) {
  ASSERT_EQ(hamjet(comparison("whole")).exit_code, 0);
  const Json expected = figures("whole");
  whole_time_ = measure(comparison("measured"));
  // Kills come from the first checkpoint on.
  writing_time_ = whole_time_ * 3 / 4;
  int count_fresh = 0;
  int count_resumed = 0;
  int count_partial = 0;
  int count_ended = 0;
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    fs::remove_all(directory_ / "parts");
    // Some runs are killed a second time while they are resumed.
    const int times = i % 5 == 4 ? 2 : 1;
    bool has_begun = false;
    for (int k = 0; k < times; ++k) {
      const CommandResult result =
          run_and_kill(comparison("parts", has_begun), directory_ / "parts", i);
      if (k + 1 == times && result.signal != SIGKILL) ++count_ended;
      has_begun = fs::exists(directory_ / "parts/compare.json") ||
                  fs::exists(directory_ / "parts/.hamjet-ready");
    }
    if (has_begun && fs::exists(directory_ / "parts/compare.json")) {
      count_partial += read_json(directory_ / "parts/compare.json")["complete"] == false ? 1 : 0;
    }
    ++(has_begun ? count_resumed : count_fresh);
    const CommandResult last = hamjet(comparison("parts", has_begun));
    EXPECT_EQ(last.exit_code, 0) << last.err;
    EXPECT_EQ(figures("parts"), expected);
  }
  fmt::print(
      "hamjet compare ({:.1f} ms): {} moments, {} had ended before; nothing saved yet {} times, "
      "taken up {} times, {} of them in the midst. Unreadable or other figures: {}\n",
      static_cast<double>(whole_time_.count()) / 1e3, kills(), count_ended, count_fresh,
      count_resumed, count_partial, HasFailure() ? "see above" : "0");
}

}  // namespace
}  // namespace hamjet::test
