#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "dynamics/operation_count.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/dynamics/system_text.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

/// The paper's planet as its user may write it, with two ways to write the same potential.
SystemText written(const std::string& potential) {
  SystemText text;
  text.coordinates = {"x", "y", "z"};
  text.momenta = {"px", "py", "pz"};
  text.parameters = {{"R", fmt::format("{}", paper_field.radius)},
                     {"J2", fmt::format("{}", paper_field.J[2])},
                     {"J3", fmt::format("{}", paper_field.J[3])}};
  text.definitions = {{"r", "sqrt(x^2 + y^2 + z^2)"}, {"s", "z/r"}};
  text.hamiltonian = "(px^2 + py^2 + pz^2)/2 + " + potential;
  return text;
}

/// Fixed steps, so that all do the same number of them.
FlowJet<double> integrated(const Case& c) {
  GaussSettings settings;
  settings.step = 0.75;
  IntegrationStatistics statistics;
  return integrate_gauss<double>(c.problem(), settings, statistics);
}

}  // namespace

void benchmark_own() {
  const SystemText legendre =
      written("-1/r*(1 - J2*(R/r)^2*(3*s^2 - 1)/2 - J3*(R/r)^3*(5*s^3 - 3*s)/2)");
  const SystemText powers =
      written("-1/r + J2*R^2*(3*z^2 - r^2)/(2*r^5) + J3*R^3*z*(5*z^2 - 3*r^2)/(2*r^7)");
  fmt::print("\nequations of one's own beside the built-in ones: the paper's orbit, 42 steps\n");
  fmt::print("{:>5} {:<24} {:>10} {:>15} {:>12} {:>7} {:>11}\n", "order", "equations", "operations",
             "multiply-adds*", "time", "ratio", "difference");
  for (const int order : {1, 4, 6}) {
    std::vector<std::pair<std::string, Case>> cases = {
        {"built-in", paper_case(paper_field, order)}};
    for (const auto& [name, text] : {std::pair{"text, by Legendre's", legendre},
                                     std::pair{"text, by powers of z, r", powers}}) {
      cases.emplace_back(name, cases[0].second);
      cases.back().second.system = make_system("own", text);
    }
    std::vector<std::function<void()>> works;
    for (const auto& entry : cases) works.emplace_back([&entry] { integrated(entry.second); });
    const auto seconds = median_seconds(works, 61, processor_seconds_of);
    const FlowJet<Extended> builtin = convert_map<Extended>(integrated(cases[0].second));
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case& c = cases[i].second;
      const OperationList& force = c.system.evaluated_list();
      fmt::print("{:>5} {:<24} {:>10} {:>15.0f} {:>9.3f} ms {:>7.3f} {:>11.1e}\n", order,
                 cases[i].first, force.nonlinear_operations(),
                 series_multiply_adds(force, *c.space, order), seconds[i] * 1e3,
                 seconds[i] / seconds[0], worst_error(integrated(c), builtin));
    }
  }
  std::vector<double> times;
  for (int k = 0; k < 201; ++k) {
    times.push_back(processor_seconds_of([&] { make_system("own", legendre); }));
  }
  std::nth_element(times.begin(), times.begin() + 100, times.end());
  fmt::print("reading the text: {:.3f} ms\n", times[100] * 1e3);
  fmt::print(
      "    * of the products of series, one stage; difference: of a coefficient from the built-in\n"
      "      jet's, relative to the largest of its degree\n");
}

}  // namespace hamjet::benchmarks
