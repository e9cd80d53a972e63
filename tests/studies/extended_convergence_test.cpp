#include <gtest/gtest.h>

#include <cmath>

#include "../../src/studies/comparison/convergence_fit.hpp"
#include "comparison_scenes.hpp"

// Orders of convergence that double precision cannot show; the expected orders are those of the
// theory.

namespace hamjet {
namespace {

/// log10(error) = 2 + 8 log10(h) + 0.7 (h / 0.4)^2: a slope with a term beside it, by construction.
std::vector<ConvergencePoint> made_up_points() {
  std::vector<ConvergencePoint> points;
  for (const double h : {0.05, 0.1, 0.2, 0.4}) {
    points.push_back({h, 100 * std::pow(h, 8) * std::pow(10, 0.7 * std::pow(h / 0.4, 2)), ""});
  }
  return points;
}

TEST(FittedSlope, TakesTheNextTermOut) {
  const auto with = fitted_slope(made_up_points(), 2);
  ASSERT_TRUE(with);
  EXPECT_NEAR(*with, 8, 1e-10);
  const auto without = fitted_slope(made_up_points(), 0);
  EXPECT_TRUE(!without || std::abs(*without - 8) > 0.3);
}

TEST(FittedSlope, RefusesScatter) {
  std::vector<ConvergencePoint> points = made_up_points();
  points[1].error *= 3;
  EXPECT_FALSE(fitted_slope(points, 0));
}

/// A series whose error rises again has a rounding floor of its own, above that of the best run.
TEST(UsablePoints, StayAboveTheSeriesOwnFloor) {
  ComparisonResult result;
  result.scene.duration = 1;
  result.reference.uncertainty_by_degree = {1e-20};
  const auto add = [&](const std::string& series, long steps, double error) {
    ComparedRun run;
    run.series = series;
    run.settings.step_canonical = 1.0 / static_cast<double>(steps);
    run.statistics.steps = steps;
    run.error_by_degree = {error};
    result.runs.push_back(run);
  };
  add("best", 10, 1e-15);
  long steps = 10;
  for (const double error : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 4e-12}) add("one", steps *= 2, error);
  const auto points = usable_points(result, "one", 0);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points.front().error, 1e-9);
  result.runs.pop_back();  // now it still falls: only the best run's floor, 1e-13, counts
  EXPECT_EQ(usable_points(result, "one", 0).front().error, 1e-12);
}

/// Fehlberg's pair: the term of order 9 outweighs that of order 8 at the steps that double
/// precision resolves on a whole revolution.
TEST(ExtendedConvergence, ShowsTheOrderOfFehlberg) {
  CandidateSeries series{"fehlberg", 8, false, {}};
  for (const double step : {0.25, 0.2, 0.16, 0.125, 0.1, 0.08}) {
    IntegratorSettings settings;
    settings.label = "f" + std::to_string(step);
    settings.method = IntegrationMethod::fehlberg78;
    settings.step_canonical = step;
    series.candidates.push_back({settings});
  }
  Scene scene = kepler_scene();
  scene.order = 1;
  scene.duration = 10.7;
  const auto result = compared(scene, {series});
  const auto in_double = fit_convergence(result, series, 0);
  EXPECT_TRUE(!in_double || !in_double->agrees());
  for (const int degree : {0, 1}) {
    const auto fit = fit_extended_convergence(result, series, degree, 100, [](double) {});
    ASSERT_TRUE(fit) << degree;
    EXPECT_TRUE(fit->is_extended);
    EXPECT_NEAR(fit->slope, 8, 0.3) << degree;
    ASSERT_EQ(fit->points.size(), 4U);
    EXPECT_LT(fit->points.front().second, 1e-16);  // below what double precision resolves
    EXPECT_GT(fit->points.front().second,
              result.smallest_claimed_error(degree));  // above what the reference vouches for
  }
  ASSERT_EQ(result.fits.size(), 2U);
  EXPECT_TRUE(result.fits.front().is_extended);
}

/// Where the runs would take longer than allowed there is none.
TEST(ExtendedConvergence, KeepsToItsTime) {
  CandidateSeries series{"gauss", 16, false, {}};
  for (const double step : {0.7, 0.6, 0.5}) {
    series.candidates.push_back({gauss("g" + std::to_string(step), 8, step)});
  }
  const auto result = compared(kepler_scene(), {series});
  EXPECT_FALSE(fit_extended_convergence(result, series, 2, 1e-9, [](double) {}));
}

}  // namespace
}  // namespace hamjet
