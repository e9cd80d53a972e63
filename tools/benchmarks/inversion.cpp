#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "cases.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/maps/generating_function.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {

void benchmark_inversion() {
  fmt::print(
      "\nthe paper's orbit after a quarter of its period: its map inverted, and the\n"
      "    generating functions of all 64 kinds\n");
  fmt::print("{:>5} {:>12} {:>12} {:>12} {:>14}\n", "order", "inverse", "64 kinds", "a kind",
             "of an inverse");
  for (int order = 1; order <= 6; ++order) {
    Case c = paper_case(paper_field, order);
    c.duration = paper_duration / 12;
    const FlowProblem<double> problem = c.problem();
    GaussSettings settings;
    settings.tolerance = 1e-12;
    IntegrationStatistics statistics;
    const FlowJet<double> jet = integrate_gauss<double>(problem, settings, statistics);
    const FlowJet<double> deviations = without_constants(jet);
    const std::vector<GeneratingFunctionKind> kinds = all_kinds(3);
    std::size_t coefficients = 0;  // so that nothing is left out as unused
    const auto seconds =
        median_seconds({[&] { coefficients += inverse(deviations)[0].size(); },
                        [&] {
                          for (const GeneratingFunctionKind& kind : kinds) {
                            const auto inversion = invert_partially<double>(jet, kind);
                            coefficients += generating_function(one_form(inversion)).size();
                          }
                        }},
                       order < 5 ? 51 : 11);
    if (coefficients == 0) return;
    const double a_kind = seconds[1] / static_cast<double>(kinds.size());
    fmt::print("{:>5} {:>9.4f} ms {:>9.3f} ms {:>9.2f} us {:>14.2f}\n", order, seconds[0] * 1e3,
               seconds[1] * 1e3, a_kind * 1e6, a_kind / seconds[0]);
  }
}

}  // namespace hamjet::benchmarks
