#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "hamjet/error.hpp"
#include "studies/estimated_scenes.hpp"

// How often the estimated error of a degree is below the true one, over random scenes:
//   error_estimate_statistics [scenes] [first seed]
// Exit code 1 if an estimate is below a tenth of the error in more than 1 % of the degrees, or
// below a hundredth in any.

namespace hamjet::test {
namespace {

double quantile(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

int report(int scenes, std::uint64_t first) {
  std::vector<double> ratios;
  int judged = 0, failed = 0, without = 0;
  double run_seconds = 0, estimate_seconds = 0;
  for (int k = 0; k < scenes; ++k) {
    Scene scene = estimated_scene(first + static_cast<std::uint64_t>(k));
    std::fflush(stdout);
    try {
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
      if (degrees.empty()) continue;
      ++judged;
      for (const JudgedDegree& one : degrees) {
        ratios.push_back(one.ratio());
        if (one.ratio() > 5 || one.ratio() < 1e-3) {
          fmt::print("{}: degree {}: error {:.2e}, estimate {:.2e}, ratio {:.2g}\n",
                     description(scene), one.degree, one.error, one.estimate, one.ratio());
        }
      }
    } catch (const Error& error) {
      fmt::print("{}: {}\n", description(scene), error.what());
      ++failed;
    }
  }
  std::sort(ratios.begin(), ratios.end());
  if (ratios.empty()) return 1;
  const auto above = [&](double x) {
    return ratios.end() - std::upper_bound(ratios.begin(), ratios.end(), x);
  };
  fmt::print(
      "{} scenes from seed {}: {} judged, {} failed, {} without estimate; {} degrees\n"
      "error / estimate: 1 % {:.2g}, median {:.2g}, 90 % {:.2g}, 99 % {:.2g}, largest {:.3g}\n"
      "above 10: {} of {}; above 100: {}\nruns {:.3g} s, estimates {:.3g} s\n",
      scenes, first, judged, failed, without, ratios.size(), quantile(ratios, 0.01),
      quantile(ratios, 0.5), quantile(ratios, 0.9), quantile(ratios, 0.99), ratios.back(),
      above(10), ratios.size(), above(100), run_seconds, estimate_seconds);
  const bool is_good =
      static_cast<double>(above(10)) <= 0.01 * static_cast<double>(ratios.size()) &&
      above(100) == 0;
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace hamjet::test

int main(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 300;
  const auto first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1ULL;
  return hamjet::test::report(scenes, first);
}
