#include <fmt/format.h>

#include <variant>
#include <vector>

#include "cases.hpp"
#include "dynamics/operation_count.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {

void benchmark_orders() {
  fmt::print("\npaper's orbit, Gauss with 8 stages, tolerance 1e-12: cost against order\n");
  fmt::print("{:>5} {:>6} {:>12} {:>12} {:>15} {:>16} {:>12} {:>14}\n", "order", "steps", "time",
             "memory", "multiply-adds", "ns per 1000 m-a", "growth/count", "error estimate");
  double previous_time = 0;
  double previous_count = 0;
  for (int order = 1; order <= 8; ++order) {
    const Case c = paper_case(paper_field, order);
    const FlowProblem<double> problem = c.problem();
    GaussSettings settings;
    settings.tolerance = 1e-12;
    IntegrationStatistics statistics;
    const FlowJet<double> jet = integrate_gauss<double>(problem, settings, statistics);
    const auto& lines = std::get<std::vector<JetAlongLine<double>>>(statistics.finer_lines);
    const auto times = median_seconds({[&] {
                                         IntegrationStatistics s;
                                         integrate_gauss<double>(problem, settings, s);
                                       },
                                       [&] { estimate_error<double>(problem, jet, {}, lines); }},
                                      order < 6 ? 21 : 5);
    const double time = times[0];
    // Products of series, and the linear solves and linear parts: m (m s + 2n) and, over the list's
    // values, m multiply-adds a coefficient and stage.
    const OperationList& list = c.system.second_order->force;
    const double coefficients = static_cast<double>(c.space->size());
    const double values = static_cast<double>(list.operations().size());
    const double per_stage = series_multiply_adds(list, *c.space, order) +
                             coefficients * (3.0 * (3 * 8 + 6) + 3 * values);
    const double count = per_stage * 8 * static_cast<double>(statistics.steps);
    const double memory = values * coefficients * 8 * 8;
    fmt::print("{:>5} {:>6} {:>9.3f} ms {:>9.2f} MB {:>15.3e} {:>16.1f} {:>12} {:>12.0f} %\n",
               order, statistics.steps, time * 1e3, memory * 1e-6, count, time / count * 1e12,
               previous_time > 0
                   ? fmt::format("{:.2f}", time / previous_time / (count / previous_count))
                   : "",
               100 * times[1] / time);
    previous_time = time;
    previous_count = count;
  }
  fmt::print(
      "    memory: the series of all operations on 8 lanes; growth/count: time's growth over the "
      "count's; error estimate: its time\n    in parts of the integration's\n");
}

}  // namespace hamjet::benchmarks
