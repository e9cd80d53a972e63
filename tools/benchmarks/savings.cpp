#include <fmt/format.h>

#include <string>

#include "cases.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "dynamics/operation_count.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/studies/propagation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

void integrate(const Case& c) {
  GaussSettings settings;
  settings.tolerance = 1e-12;
  IntegrationStatistics statistics;
  integrate_gauss<double>(c.problem(), settings, statistics);
}

double multiply_adds(const Case& c) {
  const OperationList& list = c.system.second_order->force;
  const int order = list.is_linear_system() ? 1 : c.space->order();
  return series_multiply_adds(list, *c.space, order);
}

/// The paper's scene with one integrator, as the command runs it.
Scene paper_scene(bool inversion, bool reference) {
  const Case c = paper_case(paper_field, 4);
  Scene scene;
  scene.system.mu_km3_s2 = 398600.4405;
  scene.system.radius_km = 6378.137;
  scene.system.J = paper_field.J;
  scene.units = {7000, 1};
  scene.canonical_radius = paper_field.radius;
  scene.nominal = c.nominal;
  scene.duration = c.duration;
  scene.order = 4;
  scene.variables = c.variables;
  IntegratorSettings gauss;
  gauss.label = "gauss8";
  gauss.tolerance = 1e-12;
  scene.integrators = {gauss};
  if (inversion) scene.kinds = {"F1"};
  if (reference) scene.reference = ReferenceSettings{};
  return scene;
}

}  // namespace

void benchmark_savings() {
  ZonalGravity without_j3 = paper_field;
  without_j3.J[3] = 0;
  const Case full = paper_case(paper_field, 4);
  Case linear = full;
  linear.system = harmonic_oscillator();
  linear.space = SeriesSpace::create(2, 4);
  linear.variables = {0, 1};
  linear.nominal = {1, 0};
  const std::vector<std::pair<std::string, Case>> cases = {
      {"full: J2 and J3, order 4", full},
      {"J3 absent", paper_case(without_j3, 4)},
      {"J2 and J3 absent", paper_case({.mu = 1}, 4)},
      {"planar equatorial, no J3", planar_case(4)},
      {"order 1", paper_case(paper_field, 1)},
      {"linear system (oscillator)", linear}};
  std::vector<std::function<void()>> works;
  for (const auto& entry : cases) works.emplace_back([&entry] { integrate(entry.second); });
  const auto seconds = median_seconds(works, 21);
  fmt::print("\nwhat a scene does not need is not computed: integration, Gauss with 8 stages\n");
  fmt::print("{:<28} {:>9} {:>11} {:>15} {:>12} {:>8}\n", "scene", "variables", "operations",
             "multiply-adds*", "time", "of full");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i].second;
    fmt::print("{:<28} {:>9} {:>11} {:>15.0f} {:>9.3f} ms {:>6.0f} %\n", cases[i].first,
               c.space->variables(), c.system.second_order->force.nonlinear_operations(),
               multiply_adds(c), seconds[i] * 1e3, 100 * seconds[i] / seconds[0]);
  }
  fmt::print("    * of the products of series, one stage; operations: the nonlinear ones\n");

  const std::vector<std::pair<std::string, Scene>> scenes = {
      {"with F1 and reference", paper_scene(true, true)},
      {"no reference", paper_scene(true, false)},
      {"no generating function", paper_scene(false, false)}};
  std::vector<std::function<void()>> runs;
  for (const auto& entry : scenes) runs.emplace_back([&entry] { propagate(entry.second); });
  const auto times = median_seconds(runs, 3);
  fmt::print("\n    the whole run of the command, order 4\n");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    fmt::print("    {:<26} {:>10.2f} ms {:>8.2f} %\n", scenes[i].first, times[i] * 1e3,
               100 * times[i] / times[0]);
  }
}

}  // namespace hamjet::benchmarks
