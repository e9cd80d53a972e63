#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "dynamics/operation_count.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

/// The paper's planet with more zonal coefficients, of the size that the Earth's have.
ZonalGravity field_with(const std::vector<int>& degrees) {
  ZonalGravity field{paper_field.mu, paper_field.radius, {}};
  for (const int n : degrees) field.J[n] = n == 2 ? 1.0826e-3 : 2.5e-6 / n;
  return field;
}

std::vector<int> up_to(int highest) {
  std::vector<int> degrees;
  for (int n = 2; n <= highest; ++n) degrees.push_back(n);
  return degrees;
}

/// Fixed steps, so that all do the same number of them.
void integrate(const Case& c) {
  GaussSettings settings;
  settings.step = 0.75;
  IntegrationStatistics statistics;
  integrate_gauss<double>(c.problem(), settings, statistics);
}

}  // namespace

void benchmark_zonals() {
  std::vector<std::pair<std::string, Case>> cases;
  cases.emplace_back("none", paper_case({.mu = 1}, 4));
  for (const int highest : {2, 3, 4, 5, 6, 10, 20}) {
    cases.emplace_back(highest == 2 ? "J2" : fmt::format("J2 to J{}", highest),
                       paper_case(field_with(up_to(highest)), 4));
  }
  cases.emplace_back("J2, J4, J6", paper_case(field_with({2, 4, 6}), 4));
  cases.emplace_back("J2, J20", paper_case(field_with({2, 20}), 4));
  std::vector<std::function<void()>> works;
  for (const auto& entry : cases) works.emplace_back([&entry] { integrate(entry.second); });
  const auto seconds = median_seconds(works, 21);
  fmt::print(
      "\nwhat zonal coefficients cost: order 4 in 6 variables, 42 steps of Gauss with 8 "
      "stages\n");
  fmt::print("{:<14} {:>11} {:>15} {:>12} {:>10}\n", "coefficients", "operations", "multiply-adds*",
             "time", "of J2");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i].second;
    const OperationList& force = c.system.second_order->force;
    fmt::print("{:<14} {:>11} {:>15.0f} {:>9.3f} ms {:>8.0f} %\n", cases[i].first,
               force.nonlinear_operations(),
               series_multiply_adds(force, *c.space, c.space->order()), seconds[i] * 1e3,
               100 * seconds[i] / seconds[1]);
  }
  fmt::print(
      "    * of the products of series, one stage; operations: the nonlinear ones. One that\n"
      "      is absent below the highest costs the recursion's steps through its degree.\n");
}

}  // namespace hamjet::benchmarks
