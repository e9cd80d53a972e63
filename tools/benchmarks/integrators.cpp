#include <fmt/format.h>

#include "cases.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr double wanted_error = 1e-12;

/// The loosest tolerance, on a grid of four a decade, whose error does not exceed the wanted one.
template <class Run>
double tolerance_for(const Run& run, const FlowJet<Extended>& reference, double loosest) {
  for (double tolerance = loosest; tolerance > 1e-15; tolerance /= 1.7782794100389228) {
    IntegrationStatistics statistics;
    if (worst_error(run(tolerance, statistics), reference) <= wanted_error) return tolerance;
  }
  return 1e-15;
}

void print_parts(const Case& c, double tolerance) {
  const FlowProblem<double> problem = c.problem();
  GaussProfile best;
  double least = 1e9;
  long steps = 0;
  for (int r = 0; r < 50; ++r) {
    GaussProfile profile;
    GaussSettings settings;
    settings.tolerance = tolerance;
    settings.profile = &profile;
    IntegrationStatistics statistics;
    integrate_gauss<double>(problem, settings, statistics);
    const double seconds = statistics.wall_seconds - statistics.choice_seconds;
    if (seconds < least) {
      least = seconds;
      best = profile;
      steps = statistics.steps;
    }
  }
  const double scale = 1e6 / static_cast<double>(steps);
  fmt::print(
      "    a step of Gauss takes {:.1f} us: series products {:.1f}, linear solves {:.1f}, linear "
      "parts and "
      "update {:.1f}, nominal {:.1f}, factorisation {:.1f}; set-up of the whole run {:.0f} us\n",
      least * scale, best.series * scale, best.linear_solves * scale, best.update * scale,
      best.nominal * scale, best.factorisation * scale,
      1e6 * (least - best.series - best.linear_solves - best.update - best.nominal -
             best.factorisation));
}

}  // namespace

void benchmark_integrators() {
  const Case c = paper_case(paper_field, 4);
  const FlowProblem<double> problem = c.problem();
  const FlowJet<Extended> reference = reference_jet(c);
  const auto gauss = [&](double tolerance, IntegrationStatistics& statistics) {
    GaussSettings settings;
    settings.tolerance = tolerance;
    return integrate_gauss<double>(problem, settings, statistics);
  };
  const auto fehlberg = [&](double tolerance, IntegrationStatistics& statistics) {
    ExplicitRungeKuttaSettings settings;
    settings.tolerance = tolerance;
    return integrate_fehlberg78<double>(problem, settings, statistics);
  };
  const double gauss_tolerance = tolerance_for(gauss, reference, 1e-11);
  const double fehlberg_tolerance = tolerance_for(fehlberg, reference, 1e-10);
  IntegrationStatistics gauss_statistics;
  IntegrationStatistics fehlberg_statistics;
  const double gauss_error = worst_error(gauss(gauss_tolerance, gauss_statistics), reference);
  const double fehlberg_error =
      worst_error(fehlberg(fehlberg_tolerance, fehlberg_statistics), reference);
  const auto seconds = median_seconds({[&] {
                                         IntegrationStatistics s;
                                         gauss(gauss_tolerance, s);
                                       },
                                       [&] {
                                         IntegrationStatistics s;
                                         fehlberg(fehlberg_tolerance, s);
                                       }},
                                      15);
  fmt::print("\npaper's orbit, order 4, error of all degrees at most {:.0e}\n", wanted_error);
  fmt::print("{:<12} {:>10} {:>7} {:>10} {:>10} {:>8}\n", "method", "tolerance", "steps", "error",
             "time", "ratio");
  fmt::print("{:<12} {:>10.1e} {:>7} {:>10.1e} {:>7.2f} ms {:>8.1f}\n", "gauss 8", gauss_tolerance,
             gauss_statistics.steps, gauss_error, seconds[0] * 1e3, 1.0);
  fmt::print("{:<12} {:>10.1e} {:>7} {:>10.1e} {:>7.2f} ms {:>8.1f}\n", "fehlberg78",
             fehlberg_tolerance, fehlberg_statistics.steps, fehlberg_error, seconds[1] * 1e3,
             seconds[1] / seconds[0]);
  print_parts(c, gauss_tolerance);

  const Case first = paper_case(paper_field, 1);
  const FlowProblem<double> first_problem = first.problem();
  const FlowJet<Extended> first_reference = reference_jet(first);
  GaussSettings settings;
  settings.tolerance = gauss_tolerance;
  IntegrationStatistics statistics;
  const double error =
      worst_error(integrate_gauss<double>(first_problem, settings, statistics), first_reference);
  const double time = median_seconds({[&] {
                                       IntegrationStatistics s;
                                       integrate_gauss<double>(first_problem, settings, s);
                                     }},
                                     51)[0];
  fmt::print("\norder 1: nominal and 6 x 6 matrix over 10 pi in {:.3f} ms, error {:.1e}\n",
             time * 1e3, error);
  print_parts(first, gauss_tolerance);
}

}  // namespace hamjet::benchmarks
