#include "judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "variations.hpp"

namespace hamjet::attack {
/// Extended precision has 113 bits.
double floor_of(const DrawnScene& drawn, double floor) {
  return drawn.precision == "extended" ? floor * 0x1p-60 : floor;
}

bool has_promise(const DrawnScene& drawn) {
  return drawn.is_adaptive_gauss() && (drawn.eccentricity <= 0.95 || drawn.eccentricity > 1);
}

double rounding_walk(const AttackedRun& attacked, const LineReference& reference) {
  const auto steps = static_cast<double>(attacked.run().statistics.steps);
  return std::sqrt(1 + steps / static_cast<double>(reference.floor_steps + 1));
}

double promised_error(const DrawnScene& drawn, const AttackedRun& attacked,
                      const LineReference& reference, double floor) {
  return 100 * *drawn.tolerance * std::max(1.0, drawn.revolutions) +
         10 * rounding_walk(attacked, reference) * floor_of(drawn, floor);
}

namespace {

class Judge {
 public:
  Judge(const DrawnScene& drawn, const JudgeSettings& settings)
      : drawn_(drawn),
        settings_(settings),
        random_(drawn.seed ^ 0x5851f42d4c957f2d, drawn.number) {}

  Verdict run() {
    const AttackedRun attacked = run_hamjet(toml(drawn_), settings_.most_seconds);
    verdict_.hamjet_seconds = attacked.seconds;
    verdict_.message = attacked.message;
    if (attacked.scene) {
      const std::string difference = misread(drawn_, *attacked.scene);
      if (!difference.empty()) find({"reading", -1, 0, 0, difference});
    }
    if (attacked.is_too_slow) {
      skip("hamjet takes too long");
    } else if (attacked.exit_code != 0 && attacked.exit_code != 1 && attacked.exit_code != 4) {
      verdict_.outcome = Verdict::Outcome::refused;
    } else {
      if (attacked.exit_code != 0) verdict_.outcome = Verdict::Outcome::marked;
      if (attacked.result && !attacked.run().jet.empty()) compare(attacked);
    }
    if (!verdict_.findings.empty()) verdict_.outcome = Verdict::Outcome::wrong;
    return verdict_;
  }

 private:
  void find(const Finding& finding) { verdict_.findings.push_back(finding); }
  void skip(const std::string& why) {
    verdict_.outcome = Verdict::Outcome::skipped;
    verdict_.message = why;
  }

  void compare(const AttackedRun& attacked) {
    const Scene& scene = *attacked.scene;
    const Model model = canonical_model(scene, drawn_.model);
    std::vector<JudgedLine> lines;
    bool keeps_promise = drawn_.is_adaptive_gauss();
    has_estimate_ = attacked.run().error_estimate.by_degree.has_value();
    for (int i = 0; i < settings_.directions; ++i) {
      const auto line = judged_line(attacked, model, i == 0, false);
      if (!line) return;
      lines.push_back(*line);
    }
    share_floors(lines);
    for (const JudgedLine& line : lines) {
      keeps_promise = keeps_promise && is_as_promised(attacked, line);
      if (attacked.is_unmarked()) compare_degrees(line.errors);
    }
    if (!keeps_promise && drawn_.is_adaptive_gauss()) {
      keeps_promise = is_as_promised_on_average(attacked, model, lines);
    }
    verdict_.is_false_alarm = attacked.exit_code == 1 && keeps_promise;
    judge_estimate(attacked, model, lines);
    if (attacked.is_unmarked() && random_.chance(settings_.variations)) vary(attacked, lines);
  }

  std::optional<JudgedLine> judged_line(const AttackedRun& attacked, const Model& model,
                                        bool is_aligned, bool has_unit_sizes) {
    const Scene& scene = *attacked.scene;
    const bool is_extended = drawn_.precision == "extended";
    const auto start = std::chrono::steady_clock::now();
    JudgedLine line;
    const auto draw = [&] {
      return has_unit_sizes ? draw_unit_direction(scene, random_)
                            : draw_direction(scene, model, random_);
    };
    line.direction =
        is_aligned ? aligned_direction(attacked.run().jet, attacked.result->problem, draw) : draw();
    line.reference =
        follow(model, {scene.nominal, line.direction, scene.duration, scene.order, has_unit_sizes},
               drawn_.number, is_extended ? 1e-28 : 1e-26, is_extended ? 1e-26 : 1e-22);
    verdict_.reference_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!line.reference.failure.empty()) {
      if (attacked.is_unmarked()) skip(line.reference.failure);
      return std::nullopt;
    }
    line.jet =
        along_line(attacked.run().jet, attacked.result->problem, line.direction, line.reference);
    line.errors = relative_errors(line.jet, line.reference);
    return line;
  }

  /// A jet is rounded in all its monomials, along whichever line they are added up. Therefore the
  /// floor of a degree is the largest floor along any of the lines.
  static void share_floors(std::vector<JudgedLine>& lines) {
    for (std::size_t k = 0; k < lines[0].errors.floor.size(); ++k) {
      double largest = 0;
      for (const JudgedLine& line : lines) largest = std::max(largest, line.errors.floor[k]);
      for (JudgedLine& line : lines) line.errors.floor[k] = largest;
    }
  }

  /// hamjet's estimate is relative to the largest coefficient. For an orbit the coefficient is in
  /// the chief's own units, in which position and momentum are of size 1 as the directions are; for
  /// other systems it is in their units.
  void judge_estimate(const AttackedRun& attacked, const Model& model,
                      std::vector<JudgedLine> lines) {
    const auto& estimate = attacked.run().error_estimate.by_degree;
    if (!estimate) return;
    if (!drawn_.is_orbit) {
      for (JudgedLine& line : lines) {
        const auto other = judged_line(attacked, model, &line == &lines[0], true);
        if (!other) return;
        line = *other;
      }
    }
    verdict_.estimate_ratio = 0;
    for (std::size_t k = 0; k < estimate->size(); ++k) {
      const double error = mean_error(lines, k);
      // Below the floor an error may be that of rounded constants, which all integrations share.
      const double floor = floor_of(drawn_, lines[0].errors.floor[k]);
      const double ratio = error <= floor ? 0 : error / estimate->at(k);
      verdict_.estimate_ratio = std::max(*verdict_.estimate_ratio, ratio);
      if (settings_.is_talkative) {
        fmt::print("  degree {}: error {:.2e}, estimate {:.2e}\n", k, error, estimate->at(k));
      }
      if (ratio > worst_estimate) {
        find({"estimate", static_cast<int>(k), error, worst_estimate * estimate->at(k), {}});
      }
    }
  }

  /// The geometric mean along the lines. Along one of the lines the errors of a degree's monomials
  /// may add up to many times the largest error, or cancel.
  static double mean_error(const std::vector<JudgedLine>& lines, std::size_t k) {
    double product = 1;
    for (const JudgedLine& line : lines) {
      product *= std::max(0.0, line.errors.error[k] - line.errors.uncertainty[k]);
    }
    return std::pow(product, 1.0 / static_cast<double>(lines.size()));
  }

  void vary(const AttackedRun& attacked, const std::vector<JudgedLine>& lines) {
    const auto start = std::chrono::steady_clock::now();
    const Variation variation = draw_variation(drawn_, random_);
    verdict_.variation = variation.name;
    for (const Finding& finding : judge_variation(variation, drawn_, attacked, lines, settings_)) {
      find(finding);
    }
    verdict_.variation_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  bool is_as_promised(const AttackedRun& attacked, const JudgedLine& line) const {
    const RelativeErrors& errors = line.errors;
    for (std::size_t k = 0; k < errors.error.size(); ++k) {
      const double promised = promised_error(drawn_, attacked, line.reference, errors.floor[k]);
      if (errors.error[k] - errors.uncertainty[k] > promised) return false;
    }
    return true;
  }

  /// The promise is about errors of coefficients. Along one line the errors of a degree's many
  /// monomials may add up; averaged over directions of random signs, the squared sum is the sum of
  /// the squares, and so are the sizes of the line. Records what is wrong without a mark.
  bool is_as_promised_on_average(const AttackedRun& attacked, const Model& model,
                                 std::vector<JudgedLine> lines) {
    constexpr int directions = 10;
    while (lines.size() < directions) {
      const auto line = judged_line(attacked, model, false, false);
      if (!line) return false;
      lines.push_back(*line);
    }
    share_floors(lines);
    bool is_kept = true;
    for (std::size_t k = 0; k < lines[0].errors.error.size(); ++k) {
      double squares = 0;
      for (const JudgedLine& line : lines) {
        const double error = std::max(0.0, line.errors.error[k] - line.errors.uncertainty[k]);
        squares += error * error;
      }
      const double error = std::sqrt(squares / static_cast<double>(lines.size()));
      const double floor = lines[0].errors.floor[k];
      const double allowed = promised_error(drawn_, attacked, lines[0].reference, floor);
      if (error <= allowed) continue;
      is_kept = false;
      if (attacked.is_unmarked() && (has_promise(drawn_) || !has_estimate_)) {
        find({"tolerance", static_cast<int>(k), error, allowed,
              fmt::format("floor {:.1e}", floor_of(drawn_, floor))});
      }
    }
    return is_kept;
  }

  void compare_degrees(const RelativeErrors& errors) {
    for (std::size_t k = 0; k < errors.error.size(); ++k) {
      const double uncertainty = errors.uncertainty[k];
      verdict_.largest_error = std::max(verdict_.largest_error, errors.error[k]);
      verdict_.largest_uncertainty = std::max(verdict_.largest_uncertainty, uncertainty);
      if (settings_.is_talkative) {
        fmt::print("  degree {}: error {:.2e}, floor {:.2e}, uncertainty {:.1e}\n", k,
                   errors.error[k], floor_of(drawn_, errors.floor[k]), uncertainty);
      }
    }
  }

  const DrawnScene& drawn_;
  const JudgeSettings& settings_;
  RandomNumbers random_;
  bool has_estimate_ = false;
  Verdict verdict_;
};

}  // namespace

Verdict judge(const DrawnScene& drawn, const JudgeSettings& settings) {
  return Judge(drawn, settings).run();
}

}  // namespace hamjet::attack
