#include "variations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "command_run.hpp"

namespace hamjet::attack {
namespace {

using Kind = Variation::Kind;

bool has_fixed_steps(const DrawnScene& drawn) { return !drawn.tolerance; }

/// q, p and d in another unit of length: lengths times `ratio`, momenta by its root, for mu = 1.
std::vector<double> in_unit(std::vector<double> state, double ratio) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    state[i] = i < state.size() / 2 ? state[i] * ratio : state[i] / std::sqrt(ratio);
  }
  return state;
}

/// The other run's jet along the same line, in the units of the first run.
JetAlongLine along_same_line(const AttackedRun& other, const JudgedLine& line, double ratio) {
  LineReference sizes;
  sizes.position_size = line.reference.position_size * ratio;
  sizes.momentum_size = line.reference.momentum_size / std::sqrt(ratio);
  JetAlongLine jet =
      along_line(other.run().jet, other.result->problem, in_unit(line.direction, ratio), sizes);
  const DoubleDouble length = DoubleDouble(1) / DoubleDouble(ratio);
  const DoubleDouble momentum = sqrt(DoubleDouble(ratio));
  for (std::size_t c = 0; c < jet.coefficients.size(); ++c) {
    for (DoubleDouble& x : jet.coefficients[c]) {
      x *= c < jet.coefficients.size() / 2 ? length : momentum;
    }
  }
  return jet;
}

/// The reference up to the lower order of the two.
LineReference cut(LineReference reference, std::size_t degrees) {
  for (auto& series : reference.coefficients) series.resize(degrees);
  reference.size.resize(degrees);
  reference.uncertainty.resize(degrees);
  reference.floor.resize(degrees);
  return reference;
}

/// The effect of rounding the start alone on the numerical map along a line, for each degree: the
/// largest change over 16 runs whose start is moved by up to half a unit in the last place of its
/// largest position or momentum. Steps that are far too long may amplify rounding more than the
/// flow does, so that the flow's floor is not valid then. Empty if a moved run fails.
std::vector<double> rounding_of_map(const AttackedRun& attacked, const JudgedLine& line,
                                    RandomNumbers& random) {
  LineReference first = line.reference;
  first.coefficients = line.jet.coefficients;
  std::vector<double> largest(first.size.size(), 0);
  for (int sample = 0; sample < floor_samples; ++sample) {
    Scene moved = *attacked.scene;
    const std::size_t n = moved.nominal.size() / 2;
    for (std::size_t c = 0; c < 2 * n; ++c) {
      const auto begin =
          attacked.scene->nominal.begin() + static_cast<std::ptrdiff_t>(c < n ? 0 : n);
      const double size =
          std::abs(*std::max_element(begin, begin + static_cast<std::ptrdiff_t>(n),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); }));
      moved.nominal[c] += random.uniform(-1, 1) * 0x1p-53 * size;
    }
    const PropagationResult result = propagate(moved);
    if (result.runs.at(0).jet.empty()) return {};
    const JetAlongLine jet =
        along_line(result.runs[0].jet, result.problem, line.direction, line.reference);
    const RelativeErrors changes = relative_errors(jet, first);
    for (std::size_t k = 0; k < largest.size(); ++k) {
      largest[k] = std::max(largest[k], changes.error[k]);
    }
  }
  return largest;
}

/// The allowed difference of two runs is ten floors of each run. If the steps are chosen, the runs
/// may have different steps, and therefore different errors.
double allowed_difference(Kind kind, const DrawnScene& drawn, const AttackedRun& attacked,
                          const JudgedLine& line, std::size_t k, double other_error) {
  // The command's numbers are read in double precision.
  const bool is_command = kind == Kind::command;
  const double floor = is_command ? line.errors.floor[k] : floor_of(drawn, line.errors.floor[k]);
  const double rounding = 20 * rounding_walk(attacked, line.reference) * floor;
  const bool has_same_steps = has_fixed_steps(drawn) || is_command;
  return has_same_steps ? rounding : rounding + 2 * (line.errors.error[k] + other_error);
}

/// The allowed difference of a map with fixed steps, from its own rounding; one sample of this
/// rounding changes the start alone.
double allowed_from_map(const AttackedRun& attacked, double rounding) {
  return 20 * std::sqrt(1 + static_cast<double>(attacked.run().statistics.steps)) * rounding;
}

/// Compares both runs with the reference. The error must be within the tolerance's promise, and a
/// run in one piece need not be better than ten times the tolerance.
void compare(const Variation& variation, const DrawnScene& drawn, const AttackedRun& attacked,
             const AttackedRun& other, const JudgedLine& line, std::vector<Finding>& findings) {
  const double ratio = attacked.scene->units.length_km / other.scene->units.length_km;
  const JetAlongLine jet = along_same_line(other, line, ratio);
  const LineReference reference = cut(line.reference, jet.independent_sum.size());
  const RelativeErrors errors = relative_errors(jet, reference);
  LineReference first = reference;
  for (std::size_t c = 0; c < first.coefficients.size(); ++c) {
    std::copy_n(line.jet.coefficients[c].begin(), jet.independent_sum.size(),
                first.coefficients[c].begin());
  }
  const RelativeErrors differences = relative_errors(jet, first);
  RandomNumbers random(drawn.seed ^ 0x2545f4914f6cdd1d, drawn.number);
  std::optional<std::vector<double>> own_rounding;  // sampled when it is needed
  for (std::size_t k = 0; k < errors.error.size(); ++k) {
    const auto add = [&](const char* rule, double value, double allowed) {
      if (value > allowed) {
        findings.push_back({rule, static_cast<int>(k), value, allowed, variation.name});
      }
    };
    const double error = errors.error[k] - errors.uncertainty[k];
    const double floor = std::max(errors.floor[k], line.errors.floor[k]);
    if (has_promise(variation.drawn)) {
      double promised = promised_error(variation.drawn, other, line.reference, floor);
      // In another unit the start is rounded anew, but the reference is that of the first start.
      if (variation.kind == Kind::unit) {
        promised += 10 * rounding_walk(other, line.reference) * floor_of(drawn, floor);
      }
      add("tolerance of the variation", error, promised);
    }
    if (variation.kind == Kind::unsplit) {
      // If the error of one piece is below the tolerance for each revolution, it is so by luck.
      const double promised = drawn.tolerance.value_or(0) * std::max(1.0, drawn.revolutions);
      const double rounding = rounding_walk(attacked, line.reference) * floor_of(drawn, floor);
      const double least = std::max(rounding, promised);
      add("arcs against one piece", line.errors.error[k] - errors.uncertainty[k],
          10 * std::max(errors.error[k], least));
    } else if (variation.kind == Kind::zeros) {
      add("zeros against nothing", differences.error[k], 0);
    } else {
      double allowed =
          allowed_difference(variation.kind, drawn, attacked, line, k, errors.error[k]);
      if (has_fixed_steps(drawn) && differences.error[k] > allowed) {
        if (!own_rounding) own_rounding = rounding_of_map(attacked, line, random);
        if (k < own_rounding->size()) {
          allowed = std::max(allowed, allowed_from_map(attacked, own_rounding->at(k)));
        }
      }
      add("difference", differences.error[k], allowed);
    }
  }
}

}  // namespace

Variation draw_variation(const DrawnScene& drawn, RandomNumbers& random) {
  Variation variation{Kind::none, {}, drawn};
  DrawnScene& other = variation.drawn;
  const auto become = [&](Kind kind, std::string name) {
    variation.kind = kind;
    variation.name = std::move(name);
  };
  const int choice = random.integer(0, 59);
  if (choice == 0) {
    become(Kind::command, "by the command");
  } else if (choice < 5 && drawn.precision == "double" && drawn.order <= 3 &&
             drawn.revolutions < 2 && has_fixed_steps(drawn)) {
    other.precision = "extended";
    become(Kind::precision, "in extended precision");
  } else if (choice < 10 && drawn.model.radius > 0) {
    other.has_zeros = true;
    become(Kind::zeros, "with zeros written out");
  } else if (choice < 18 && drawn.order > 1) {
    other.order = random.integer(1, drawn.order - 1);
    become(Kind::order, fmt::format("to order {}", other.order));
  } else if (choice < 25 && !drawn.variables.empty()) {
    other.variables.clear();
    become(Kind::variables, "in all variables");
  } else if (choice < 38 && drawn.arcs != 1) {
    other.arcs = 1;
    become(Kind::unsplit, "in one piece");
  } else if (choice >= 50 && drawn.is_orbit && drawn.arcs == 1) {
    other.keeps_rotation = true;
    become(Kind::symmetry, "with its rotation integrated");
  } else if (drawn.is_orbit && drawn.precision == "double") {
    // The start is rounded to binary64 in the unit, and extended precision would see the rounding.
    other.length_km = random.log_uniform(1e-3, 1.5e8);
    become(Kind::unit, fmt::format("with the unit {:.3g} km", *other.length_km));
  }
  return variation;
}

std::vector<Finding> judge_variation(const Variation& variation, const DrawnScene& drawn,
                                     const AttackedRun& attacked,
                                     const std::vector<JudgedLine>& lines,
                                     const JudgeSettings& settings) {
  std::vector<Finding> findings;
  if (variation.kind == Kind::none) return findings;
  if (variation.kind == Kind::command) {
    if (settings.command.empty()) return findings;
    CommandRun command = run_command(settings.command, toml(drawn), attacked);
    if (!command.difference.empty()) {
      findings.push_back({"command", -1, 0, 0, command.difference});
      return findings;
    }
    // This program has templates of its own, which the linker may prefer to the library's, so that
    // the last digits may differ.
    AttackedRun other = attacked;
    other.result->runs.at(0).jet = std::move(command.jet);
    for (const JudgedLine& line : lines) {
      compare(variation, drawn, attacked, other, line, findings);
    }
    return findings;
  }
  const AttackedRun other = run_hamjet(toml(variation.drawn), settings.most_seconds);
  // A variation that is marked is not wrong in silence.
  if (!other.is_unmarked()) return findings;
  for (const JudgedLine& line : lines) {
    compare(variation, drawn, attacked, other, line, findings);
  }
  return findings;
}

}  // namespace hamjet::attack
