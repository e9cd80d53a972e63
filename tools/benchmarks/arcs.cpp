#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

bool is_same(const FlowJet<double>& a, const FlowJet<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      if (a[i][k] != b[i][k]) return false;
    }
  }
  return true;
}

/// One composition of two maps, beside a step.
void compare_compositions(const FlowJet<double>& jet, double step_seconds) {
  const auto deviations = without_constants(jet);
  const auto seconds =
      median_seconds({[&] { compose(jet, deviations); }, [&] { inverse(deviations); }}, 9);
  fmt::print("    a composition takes {:.3f} ms, an inversion {:.3f} ms, a step {:.3f} ms\n",
             seconds[0] * 1e3, seconds[1] * 1e3, step_seconds * 1e3);
}

void benchmark_order(int order, double revolutions) {
  Case c = paper_case(paper_field, order);
  c.duration = revolutions * 2 * 3.141592653589793 * std::pow(1 / 0.7, 1.5);
  const FlowProblem<double> problem = c.problem();
  GaussSettings settings;
  settings.tolerance = 1e-12;
  IntegrationStatistics statistics;
  const auto whole = integrate_gauss<double>(problem, settings, statistics);
  GaussSettings finer = settings;
  finer.stages = 12;
  finer.tolerance = 1e-15;
  IntegrationStatistics ignored;
  const auto reference = convert_map<Extended>(integrate_gauss<double>(problem, finer, ignored));

  std::vector<FlowJet<double>> jets;
  std::vector<std::string> names;
  std::vector<std::function<void()>> works;
  jets.reserve(16);
  const auto add = [&](const std::string& name, const std::function<FlowJet<double>()>& work) {
    FlowJet<double>& jet = jets.emplace_back();
    names.push_back(name);
    works.emplace_back([&jet, work] { jet = work(); });
  };
  add("unsplit", [&] {
    IntegrationStatistics s;
    return integrate_gauss<double>(problem, settings, s);
  });
  std::array<ArcStatistics, 8> arcs;
  std::size_t place = 0;
  for (const std::optional<std::size_t>& asked :
       {std::optional<std::size_t>(2), std::optional<std::size_t>()}) {
    for (const std::size_t threads : {1U, 2U, 4U}) {
      ArcStatistics& filled = arcs.at(place++);
      add(fmt::format("{}, {} thread{}", asked ? "2 arcs" : "auto", threads,
                      threads == 1 ? "" : "s"),
          [&problem, &settings, asked, threads, &filled] {
            IntegrationStatistics s;
            return integrate_in_arcs<double>(problem, settings, {asked, threads}, s, filled);
          });
    }
  }
  const auto seconds = median_seconds(works, 15);
  fmt::print("order {}, {} revolutions, {} steps\n", order, revolutions, statistics.steps);
  fmt::print("    {:<18} {:>4} {:>12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "", "arcs", "time",
             "unsplit/", "1 thread/", "estimate", "nominal", "composing", "error");
  for (std::size_t i = 0; i < works.size(); ++i) {
    const bool is_split = i > 0;
    const ArcStatistics* a = is_split ? &arcs.at(i - 1) : nullptr;
    const std::size_t of_one_thread = is_split ? 1 + (i - 1) / 3 * 3 : 0;
    fmt::print("    {:<18} {:>4} {:>9.3f} ms {:>9.2f} {:>9} {:>9} {:>9} {:>9} {:>11.1e}\n",
               names[i], is_split ? a->plan.arcs : 1, seconds[i] * 1e3, seconds[0] / seconds[i],
               is_split ? fmt::format("{:.2f}", seconds[of_one_thread] / seconds[i]) : "",
               is_split ? fmt::format("{:.2f}", a->plan.speed_ups.at((i - 1) % 3)) : "",
               is_split ? fmt::format("{:.1f} %", 100 * a->nominal_seconds / seconds[i]) : "",
               is_split ? fmt::format("{:.1f} %", 100 * a->composition_seconds / seconds[i]) : "",
               worst_error(jets[i], reference));
  }
  const bool same = is_same(jets[1], jets[2]) && is_same(jets[1], jets[3]) &&
                    is_same(jets[4], jets[5]) && is_same(jets[4], jets[6]);
  fmt::print("    bits on 1, 2 and 4 threads: {}\n", same ? "equal" : "DIFFERENT");
  compare_compositions(whole, seconds[0] / static_cast<double>(statistics.steps));
}

}  // namespace

void benchmark_arcs() {
  fmt::print(
      "\none arc in pieces, on threads: paper's orbit, Gauss with 8 stages, tolerance 1e-12\n");
  for (const int order : {4, 6}) benchmark_order(order, 15);
  fmt::print(
      "    error: largest over all degrees, against 12 stages at tolerance 1e-15; estimate: from "
      "counts\n");
}

}  // namespace hamjet::benchmarks
