#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "cases.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/gauss_many.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

/// Orbits from perigee, of eccentricities up to `most` and any inclination.
std::vector<std::vector<double>> orbits(std::size_t count, double most) {
  std::mt19937_64 generator(1);
  const auto draw = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double speed = std::sqrt(1 + most * draw());
    const double inclination = std::acos(2 * draw() - 1);
    result.push_back({1, 0, 0, 0, speed * std::cos(inclination), speed * std::sin(inclination)});
  }
  return result;
}

}  // namespace

void benchmark_many() {
  constexpr std::size_t count = 256;
  fmt::print("\n{} orbits about the oblate Earth, each its own jet over 10 pi, tolerance 1e-12\n",
             count);
  fmt::print("{:>14} {:>6} {:>15} {:>15} {:>7} {:>7} {:>12}\n", "eccentricities", "order",
             "one at a time", "side by side", "ratio", "alone", "difference");
  for (const double most : {0.0, 0.3, 0.7}) {
    const auto states = orbits(count, most);
    for (int order = 1; order <= highest_order_in_lanes; ++order) {
      FlowProblem<double> problem = paper_case(paper_field, order).problem();
      GaussSettings settings;
      settings.tolerance = 1e-12;
      std::vector<FlowJet<double>> single(count);
      std::vector<ManyFlowsOutcome> many;
      const auto times =
          median_seconds({[&] {
                            for (std::size_t i = 0; i < count; ++i) {
                              problem.initial_state = states[i];
                              IntegrationStatistics statistics;
                              single[i] = integrate_gauss<double>(problem, settings, statistics);
                            }
                          },
                          [&] { many = integrate_gauss_many(problem, states, settings); }},
                         5);
      double difference = 0;
      for (std::size_t i = 0; i < count; ++i) {
        difference =
            std::max(difference, worst_error(many[i].jet, convert_map<Extended>(single[i])));
      }
      const auto alone = std::count_if(many.begin(), many.end(),
                                       [](const ManyFlowsOutcome& o) { return o.was_alone; });
      fmt::print("{:>14} {:>6} {:>12.1f} us {:>12.1f} us {:>7.2f} {:>7} {:>12.1e}\n",
                 fmt::format("0 to {:.1f}", most), order, times[0] / count * 1e6,
                 times[1] / count * 1e6, times[0] / times[1], alone, difference);
    }
  }
  fmt::print(
      "    times of an orbit; alone: orbits that lanes did not suffice for; difference: the "
      "largest "
      "of a coefficient, relative to\n    the largest of its degree\n");
}

}  // namespace hamjet::benchmarks
