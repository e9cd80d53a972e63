#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/estimated_deputies.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "studies/checks/error_promise.hpp"
#include "studies/estimates/estimated_forces.hpp"
#include "studies/estimates/estimated_jets.hpp"
#include "studies/estimates/estimated_scenes.hpp"

// How often an estimate is below the true error, and how often far above it, over random inputs:
//   error_estimate_statistics [scenes|forces|jets|floors|deputies] [count] [first seed]
// which `cmake --build build --target error_estimate_statistics` makes.
// `scenes` are of all models and methods, `forces` of Gauss in air and light, `jets` of Gauss about
// orbits, `deputies` in all coordinates and frames; `floors` compares estimates of jets that
// rounding limits with what the check error-estimate takes rounding for. Exit code 1 if an estimate
// is below a tenth of the error in more than 1 % of them, or below a thirtieth in any (of scenes,
// whose coarse steps resolve nothing, below a hundredth).

namespace hamjet::test {
namespace {

double quantile(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// Ratios of errors to their estimates.
class Ratios {
 public:
  /// An error below rounding may have any size, and its estimate is not too high for it.
  void add(double error, double estimate, double rounding, const std::string& what) {
    ratios_.push_back(error / estimate);
    const double excess = estimate / std::max(error, rounding);
    const bool is_high = excess > 10;
    high_ += is_high ? 1 : 0;
    rather_high_ += excess > 30 ? 1 : 0;
    very_high_ += excess > 100 ? 1 : 0;
    if (error > 5 * estimate) {
      fmt::print("{}: error {:.2e}, estimate {:.2e}, ratio {:.3g}\n", what, error, estimate,
                 error / estimate);
    }
    if (is_high && shows_high_) {
      fmt::print("{}: error {:.2e}, estimate {:.2e}: too high\n", what, error, estimate);
    }
  }

  bool print(double most) {
    std::sort(ratios_.begin(), ratios_.end());
    if (ratios_.empty()) return false;
    const auto above = [&](double x) {
      return ratios_.end() - std::upper_bound(ratios_.begin(), ratios_.end(), x);
    };
    fmt::print(
        "error / estimate of {}: 1 % {:.2g}, median {:.2g}, 90 % {:.2g}, 99 % {:.2g}, largest "
        "{:.3g}\ntoo low by more than 10: {}, 30: {}, 100: {}; too high by more than 10: {}, 30: "
        "{}, 100: {}\n",
        ratios_.size(), quantile(ratios_, 0.01), quantile(ratios_, 0.5), quantile(ratios_, 0.9),
        quantile(ratios_, 0.99), ratios_.back(), above(10), above(30), above(100), high_,
        rather_high_, very_high_);
    return static_cast<double>(above(10)) <= 0.01 * static_cast<double>(ratios_.size()) &&
           above(most) == 0;
  }

 private:
  std::vector<double> ratios_;
  int high_ = 0;
  int rather_high_ = 0;
  int very_high_ = 0;
  bool shows_high_ = std::getenv("HAMJET_SHOW_HIGH") != nullptr;
};

bool report_scenes(int count, std::uint64_t first, Scene (*draw)(std::uint64_t)) {
  Ratios ratios;
  int judged = 0, failed = 0, without = 0;
  double run_seconds = 0, estimate_seconds = 0;
  for (int k = 0; k < count; ++k) {
    std::fflush(stdout);
    Scene scene;
    try {
      scene = draw(first + static_cast<std::uint64_t>(k));
      const PropagationResult result = propagate(scene);
      const RunResult& run = result.runs.front();
      if (!run.failure.empty() || !result.reference) {
        ++failed;
        continue;
      }
      run_seconds += run.statistics.wall_seconds;
      estimate_seconds += run.error_estimate.seconds;
      if (!run.error_estimate.by_degree) {
        ++without;
        fmt::print("{}: no estimate: {}\n", description(scene), run.error_estimate.failure);
        continue;
      }
      const auto degrees = judged_degrees(result);
      judged += degrees.empty() ? 0 : 1;
      for (const JudgedDegree& one : degrees) {
        ratios.add(one.error, one.estimate, rounding_of(scene.precision),
                   fmt::format("{}, degree {}", description(scene), one.degree));
      }
    } catch (const Error& error) {
      fmt::print("seed {}: {}\n", first + static_cast<std::uint64_t>(k), error.what());
      ++failed;
    }
  }
  fmt::print("{} scenes from seed {}: {} judged, {} failed, {} without estimate\n", count, first,
             judged, failed, without);
  fmt::print("runs {:.3g} s, estimates {:.3g} s\n", run_seconds, estimate_seconds);
  return ratios.print(100);
}

/// Draws from the first seed on until the given number is judged. `add` takes a seed, adds the
/// ratios of its draw (none if the draw cannot be judged), and returns their number.
bool report(const char* what, int count, std::uint64_t first,
            const std::function<std::size_t(std::uint64_t, Ratios&)>& add) {
  Ratios ratios;
  int judged = 0;
  std::uint64_t seed = first;
  for (; judged < count; ++seed) {
    std::fflush(stdout);
    judged += add(seed, ratios) > 0 ? 1 : 0;
  }
  fmt::print("{} {}, seeds {} to {}\n", judged, what, first, seed - 1);
  return ratios.print(30);
}

std::size_t add_jet(std::uint64_t seed, Ratios& ratios) {
  const Scene scene = estimated_jet(seed);
  const auto degrees = judged_degrees_of_jet(scene);
  for (const JudgedDegree& one : degrees) {
    ratios.add(one.error, one.estimate, rounding_of(scene.precision),
               fmt::format("{}, degree {}, {} steps at {:.0e}", description(scene), one.degree,
                           scene.duration, scene.integrators[0].tolerance.value_or(0)));
  }
  return degrees.size();
}

/// Of a jet in doubt, whose tolerance rounding does not let be kept: its estimates over the
/// rounding floors of the check error-estimate, with which they are of one size if the floors are
/// right.
std::size_t add_floor(std::uint64_t seed, Ratios& ratios) {
  Scene scene = estimated_jet(seed);
  IntegratorSettings& settings = scene.integrators[0];
  if (!settings.tolerance) return 0;
  settings.tolerance = 1e-15;
  scene.reference.reset();
  const RunResult run = propagate(scene).runs.front();
  if (!run.failure.empty() || !run.error_estimate.by_degree) return 0;
  if (run.statistics.rounding_by_degree.empty()) return 0;
  const PromisedErrors promised = promised_errors(scene, run);
  std::size_t count = 0;
  for (std::size_t d = 0; d < promised.rounding.size(); ++d) {
    const double estimate = (*run.error_estimate.by_degree)[d] - promised.of_tolerance;
    const double floor = promised.rounding[d];
    if (!(floor > promised.of_tolerance)) continue;
    ratios.add(estimate, floor, 0, fmt::format("{}, degree {}", description(scene), d));
    ++count;
  }
  return count;
}

std::size_t add_deputy(std::uint64_t seed, Ratios& ratios) {
  const DrawnDeputy drawn = drawn_deputy(seed);
  const auto one = judged_deputy(drawn);
  if (!one) return 0;
  const cli::MissEstimate& told = one->estimate;
  ratios.add(one->error_m, told.miss_m(), 1e-9,
             fmt::format("{} (truncation {:.2e}, rounding {:.2e}, integration {:.2e})",
                         description(drawn, *one), told.truncation_m, told.rounding_m,
                         told.integration_m));
  return 1;
}

}  // namespace
}  // namespace hamjet::test

int main(int argc, char** argv) {
  using namespace hamjet::test;
  const std::string_view what = argc > 1 ? argv[1] : "scenes";
  const int count = argc > 2 ? std::atoi(argv[2]) : 300;
  const auto first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1ULL;
  if (what == "scenes") return report_scenes(count, first, estimated_scene) ? 0 : 1;
  if (what == "forces") return report_scenes(count, first, estimated_in_forces) ? 0 : 1;
  if (what == "jets") return report("jets", count, first, add_jet) ? 0 : 1;
  if (what == "floors") return report("floors", count, first, add_floor) ? 0 : 1;
  if (what == "deputies") return report("deputies", count, first, add_deputy) ? 0 : 1;
  fmt::print(stderr, "scenes, forces, jets, floors or deputies\n");
  return 2;
}
