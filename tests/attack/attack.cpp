// Random scenes against an independent integration: see the usage below.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "drawn_scene.hpp"
#include "judge.hpp"
#include "kepler_check.hpp"

namespace hamjet::attack {
namespace {

constexpr const char* usage =
    "usage: attack [--scenes N] [--seed S] [--scene K] [--seconds T] [--command PATH] [--verbose]\n"
    "              [--print]\n"
    "  Draws N scenes (default 100) from the seed (default: random, and printed), runs each "
    "through\n"
    "  hamjet and compares all degrees of its jet along random lines with an integration of its\n"
    "  own. --scene K does scene K alone, --print writes its text; --seconds ends earlier;\n"
    "  --verbose has a line for each scene; --command is the program that some scenes are given "
    "to\n"
    "  as well. Exit code 1 if anything is wrong and not marked.\n";

struct Options {
  std::uint64_t scenes = 100;
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> scene;
  double seconds = HUGE_VAL;
  std::string command;
  bool is_verbose = false;
  bool is_printing = false;
};

std::optional<Options> read_options(int count, char** arguments) {
  Options options;
  options.seed = std::random_device()();
  for (int i = 1; i < count; ++i) {
    const std::string name = arguments[i];
    if (name == "--verbose") {
      options.is_verbose = true;
    } else if (name == "--print") {
      options.is_printing = true;
    } else if (i + 1 == count) {
      return std::nullopt;
    } else if (name == "--command") {
      options.command = arguments[++i];
    } else {
      char* end = nullptr;
      const char* text = arguments[++i];
      const double number = std::strtod(text, &end);
      if (end == text || *end != 0 || number < 0) return std::nullopt;
      const auto whole = static_cast<std::uint64_t>(number);
      if (name == "--scenes") {
        options.scenes = whole;
      } else if (name == "--seed") {
        options.seed = whole;
      } else if (name == "--scene") {
        options.scene = whole;
      } else if (name == "--seconds") {
        options.seconds = number;
      } else {
        return std::nullopt;
      }
    }
  }
  return options;
}

const char* name_of(Verdict::Outcome outcome) {
  static const char* const names[] = {"right", "WRONG", "marked", "refused", "skipped"};
  return names[static_cast<std::size_t>(outcome)];
}

void print_verdict(const DrawnScene& drawn, const Verdict& verdict) {
  fmt::print("seed {} scene {}: {}: {}{}{}; error {:.1e}, {:.2f} s + {:.2f} s{}{}\n", drawn.seed,
             drawn.number, verdict.is_false_alarm ? "marked, but right" : name_of(verdict.outcome),
             summary(drawn), verdict.variation.empty() ? "" : ", also ", verdict.variation,
             verdict.largest_error, verdict.hamjet_seconds, verdict.reference_seconds,
             verdict.message.empty() ? "" : ": ", verdict.message);
  for (const Finding& finding : verdict.findings) {
    fmt::print("    {}{}: {:.2e} where {:.2e} is allowed{}{}\n", finding.rule,
               finding.degree < 0 ? "" : fmt::format(" at degree {}", finding.degree),
               finding.value, finding.allowed, finding.words.empty() ? "" : ", ", finding.words);
  }
  std::fflush(stdout);
}

int attack(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  JudgeSettings settings;
  settings.is_talkative = options.scene.has_value();
  settings.command = options.command;
  std::map<Verdict::Outcome, int> counts;
  double hamjet_seconds = 0, reference_seconds = 0, uncertainty = 0, worst_ratio = 0;
  int estimates = 0, low_estimates = 0, false_alarms = 0;
  const std::uint64_t first = options.scene.value_or(0);
  const std::uint64_t last = options.scene ? first + 1 : options.scenes;
  std::uint64_t done = 0;
  for (std::uint64_t number = first; number < last && elapsed() < options.seconds; ++number) {
    const DrawnScene drawn = draw_scene(options.seed, number);
    if (options.is_printing) fmt::print("{}", toml(drawn));
    const Verdict verdict = judge(drawn, settings);
    ++counts[verdict.outcome];
    ++done;
    hamjet_seconds += verdict.hamjet_seconds;
    reference_seconds += verdict.reference_seconds;
    uncertainty = std::max(uncertainty, verdict.largest_uncertainty);
    if (verdict.is_false_alarm) ++false_alarms;
    if (verdict.estimate_ratio) {
      ++estimates;
      worst_ratio = std::max(worst_ratio, *verdict.estimate_ratio);
      if (*verdict.estimate_ratio > good_estimate) ++low_estimates;
    }
    if (options.is_verbose || options.scene || verdict.outcome == Verdict::Outcome::wrong) {
      print_verdict(drawn, verdict);
    }
  }
  const double own = difference_from_closed_form(options.seed, 3);
  fmt::print("seed {}: {} scenes in {:.0f} s:", options.seed, done, elapsed());
  for (const auto& [outcome, count] : counts) fmt::print(" {} {},", count, name_of(outcome));
  fmt::print(
      " {:.0f} s in hamjet, {:.0f} s in the independent integration, whose uncertainty is {:.0e} "
      "at "
      "worst\n",
      hamjet_seconds, reference_seconds, uncertainty);
  fmt::print(
      "the independent integration differs from the closed form of Kepler's problem by {:.0e}; {} "
      "of "
      "the marked runs of adaptive Gauss keep what the tolerance promises; of {} estimates "
      "of "
      "the error {} are more than {:g} times too low, the worst {:.1f} times\n",
      own, false_alarms, estimates, low_estimates, good_estimate, worst_ratio);
  const bool has_good_estimates = low_estimates <= std::max(1, estimates / 100);
  // The attacker must be far more exact than what it attacks.
  const bool is_right = counts[Verdict::Outcome::wrong] == 0 && has_good_estimates && own < 1e-17;
  return is_right ? 0 : 1;
}

}  // namespace
}  // namespace hamjet::attack

int main(int count, char** arguments) {
  const auto options = hamjet::attack::read_options(count, arguments);
  if (!options) {
    fmt::print(stderr, "{}", hamjet::attack::usage);
    return 2;
  }
  return hamjet::attack::attack(*options);
}
