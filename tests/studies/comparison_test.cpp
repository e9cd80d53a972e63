#include "hamjet/studies/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "comparison_scenes.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {
namespace {

/// A store in memory that counts its calls.
class MemoryStore : public ReferenceStore {
 public:
  std::optional<ReferenceResult> load(const std::string& key, const SpacePointer&) override {
    const auto place = references.find(key);
    if (place == references.end()) return std::nullopt;
    return place->second;
  }
  void save(const std::string& key, const ReferenceResult& reference) override {
    references.emplace(key, reference);
  }
  std::map<std::string, ReferenceResult> references;
};

TEST(Comparison, PutsEachRunInItsCorner) {
  // In the broken jet one linear coefficient is wrong by a thousandth: 10 m at 10 km.
  Candidate broken{gauss("broken", 8, 0.2)};
  broken.integrate = [](const FlowProblem<double>& problem, IntegrationStatistics& statistics,
                        const StepObserver<double>& observer) {
    GaussSettings settings;
    settings.step = 0.2;
    auto jet = integrate_gauss<double>(problem, settings, statistics, observer);
    jet[0][problem.space->linear_index(0)] *= 1.001;
    return jet;
  };
  IntegratorSettings fehlberg;
  fehlberg.label = "fehlberg";
  fehlberg.method = IntegrationMethod::fehlberg78;
  fehlberg.tolerance = 1e-9;
  const auto result = compared(
      kepler_scene(), {series_of("good", {{gauss("good", 8, 0.2)}}),
                       series_of("coarse", {{gauss("coarse", 1, 0.2)}}),
                       series_of("fehlberg", {{fehlberg}}), series_of("broken", {broken})});
  EXPECT_EQ(run_of(result, "good").corner, Corner::exact_and_accurate);
  EXPECT_EQ(run_of(result, "coarse").corner, Corner::exact_but_wrong);
  EXPECT_EQ(run_of(result, "fehlberg").corner, Corner::accurate_not_symplectic);
  EXPECT_EQ(run_of(result, "broken").corner, Corner::neither);
  // One coefficient off by the fraction f of itself shows as the error at degree 1.
  EXPECT_GT(run_of(result, "broken").error_by_degree[1], 1e-4);
  EXPECT_LT(run_of(result, "good").error_by_degree[1], 1e-12);
}

TEST(Comparison, FittedOrdersAgreeWithTheory) {
  Scene scene = kepler_scene();
  std::vector<CandidateSeries> all;
  const std::map<int, double> finest = {{1, 0.002}, {2, 0.01}, {3, 0.02}, {4, 0.04}};
  for (const auto& [stages, step] : finest) {
    CandidateSeries series{"s" + std::to_string(stages), 2.0 * stages, false, {}};
    for (int k = 5; k >= 0; --k) {
      const double h = step * std::pow(1.5, k);
      series.candidates.push_back(
          {gauss("s" + std::to_string(stages) + "-" + std::to_string(k), stages, h)});
    }
    all.push_back(series);
  }
  const auto result = compared(scene, all);
  std::set<std::pair<std::string, int>> fitted;
  for (const ConvergenceFit& fit : result.fits) {
    EXPECT_NEAR(fit.slope, fit.expected, 0.3) << fit.series << " degree " << fit.degree;
    EXPECT_GE(fit.labels.size(), 3U);
    for (const std::string& label : fit.labels) {
      const double error =
          run_of(result, label).error_by_degree[static_cast<std::size_t>(fit.degree)];
      EXPECT_GT(error, 2e-14) << label;  // a hundred roundings of double
    }
    fitted.emplace(fit.series, fit.degree);
  }
  EXPECT_EQ(fitted.size(), 8U);  // four series, degrees 0 and 2
}

/// The figures of a run that do not depend on the machine.
void expect_same_figures(const ComparedRun& a, const ComparedRun& b) {
  EXPECT_EQ(a.settings.label, b.settings.label);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.failure, b.failure);
  EXPECT_EQ(a.error_by_degree, b.error_by_degree);
  EXPECT_EQ(a.error_at_formation_m, b.error_at_formation_m);
  EXPECT_EQ(a.largest_symplecticity(), b.largest_symplecticity());
  EXPECT_EQ(a.energy_error, b.energy_error);
  EXPECT_EQ(a.corner, b.corner);
  EXPECT_EQ(a.statistics.steps, b.statistics.steps);
  EXPECT_EQ(a.seconds.size(), b.seconds.size());
}

TEST(Comparison, InterruptedAndResumedGivesTheSameFigures) {
  struct Stop {};
  Scene scene = kepler_scene();
  scene.comparison.methods = {IntegrationMethod::gauss, IntegrationMethod::fehlberg78};
  scene.comparison.stages = {4};
  scene.comparison.tolerances = {1e-4, 1e-8};
  scene.comparison.repeats = 2;
  scene.integrators = {gauss("watched", 2, 0.1)};
  ComparisonResult whole;
  compare(scene, {}, whole);
  ASSERT_TRUE(whole.is_complete);

  // The times are of a task and a part of it, not of a number of calls: short integrations are
  // repeated as often as the machine's speed requires.
  struct Place {
    const char* task;
    double part;
  };
  for (const Place place : {Place{"reference", 0.5}, Place{"judging runs", 0.4},
                            Place{"along time: watched", 0.5}, Place{"timing", 0.6}}) {
    SCOPED_TRACE(place.task);
    ComparisonResult result;
    ComparisonOptions options;
    options.progress = [&](const std::string& task, double part) {
      if (task == place.task && part >= place.part) throw Stop{};
    };
    EXPECT_THROW(compare(scene, options, result), Stop);
    EXPECT_FALSE(result.is_complete);
    compare(scene, {}, result);
    EXPECT_TRUE(result.is_complete);
    ASSERT_EQ(result.runs.size(), whole.runs.size());
    for (std::size_t i = 0; i < whole.runs.size(); ++i) {
      expect_same_figures(result.runs[i], whole.runs[i]);
    }
    ASSERT_EQ(result.cost_runs.size(), whole.cost_runs.size());
    for (std::size_t i = 0; i < whole.cost_runs.size(); ++i) {
      expect_same_figures(result.cost_runs[i], whole.cost_runs[i]);
    }
    ASSERT_EQ(result.along_time.size(), 1U);
    EXPECT_EQ(result.along_time[0].points.size(), whole.along_time[0].points.size());
  }
}

TEST(Comparison, AnInterruptedResumptionLosesNothing) {
  struct Stop {};
  Scene scene = kepler_scene();
  scene.comparison.methods = {IntegrationMethod::gauss};
  scene.comparison.stages = {2, 4, 4};  // the same comparison twice gives the same
  scene.comparison.tolerances = {1e-4, 1e-8};
  ComparisonResult result;
  compare(scene, {}, result);
  const std::size_t runs = result.runs.size();
  const std::size_t costs = result.cost_runs.size();
  EXPECT_EQ(runs, 4U);
  ComparisonOptions options;
  options.progress = [](const std::string&, double) { throw Stop{}; };
  MemoryStore store;
  options.references = &store;
  store.references.emplace(reference_key(scene, scene.order), result.reference);
  result.runs[2]
      .error_by_degree.clear();  // a damaged entry is judged again, and the signal comes there
  EXPECT_THROW(compare(scene, options, result), Stop);
  EXPECT_EQ(result.runs.size(), runs - 1);
  EXPECT_EQ(result.cost_runs.size(), costs);
  compare(scene, {}, result);
  EXPECT_EQ(result.runs.size(), runs);
  EXPECT_EQ(result.cost_runs.size(), costs);
}

TEST(Comparison, MarksTheTimesAtWhichTheKindDoesNotExist) {
  Scene scene = oscillator_scene();
  scene.duration = 10;
  scene.kinds = {"F1"};
  scene.integrators = {gauss("watched", 8, 0.1)};
  const auto result = compared(scene, {series_of("one", {{gauss("one", 8, 0.1)}})});
  ASSERT_EQ(result.along_time.size(), 1U);
  // F1 of the oscillator does not exist where sin t = 0.
  const auto& times = result.along_time[0].singular_times;
  ASSERT_EQ(times.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(times[k], std::numbers::pi * static_cast<double>(k + 1), 1e-4);
  }
}

TEST(Comparison, ResumesWithoutRunningAgain) {
  Scene scene = kepler_scene();
  int integrations = 0;
  Candidate counted{gauss("counted", 4, 0.2)};
  counted.integrate = [&](const FlowProblem<double>& problem, IntegrationStatistics& statistics,
                          const StepObserver<double>& observer) {
    ++integrations;
    GaussSettings settings;
    settings.stages = 4;
    settings.step = 0.2;
    auto jet = integrate_gauss<double>(problem, settings, statistics, observer);
    statistics.wall_seconds = 1;  // the run is long enough to be timed alone
    return jet;
  };
  ComparisonOptions options;
  options.series = {series_of("counted", {counted})};
  scene.comparison.orders = {2};
  ComparisonResult result;
  compare(scene, options, result);
  const int first = integrations;
  EXPECT_GE(first, 2);  // judged, then timed
  compare(scene, options, result);
  EXPECT_EQ(integrations, first);
}

TEST(Comparison, TakesTheReferenceFromTheStore) {
  MemoryStore store;
  ComparisonOptions options;
  options.references = &store;
  options.series = {series_of("one", {{gauss("one", 4, 0.2)}})};
  ComparisonResult first;
  compare(kepler_scene(), options, first);
  ComparisonResult second;
  compare(kepler_scene(), options, second);
  EXPECT_FALSE(first.is_reference_cached);
  EXPECT_TRUE(second.is_reference_cached);
  EXPECT_EQ(store.references.size(), 1U);
  EXPECT_EQ(first.runs[0].error_by_degree, second.runs[0].error_by_degree);
  Scene other = kepler_scene();
  other.duration = 3.4;
  ComparisonResult third;
  compare(other, options, third);
  EXPECT_FALSE(third.is_reference_cached);
}

TEST(Comparison, RefusesAReferenceThatDisagreesWithItself) {
  // A tolerance of 1e-16 leaves the coarser run at 1e-12, which cannot judge double precision.
  Scene scene = kepler_scene();
  scene.duration = 40;
  scene.reference = ReferenceSettings{1e-16};
  ComparisonResult result;
  try {
    compare(scene, {}, result);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_NE(std::string(error.what()).find("reference: its two runs differ"), std::string::npos)
        << error.what();
  }
}

TEST(Comparison, LeavesOutWhatTheTimeBudgetDoesNotAllowAndSaysSo) {
  Scene scene = kepler_scene();
  scene.comparison.time_budget_s = 1e-2;
  scene.comparison.orders = {2};
  const auto result = compared(
      scene, {series_of("midpoint", {{gauss("short", 1, 0.5)}, {gauss("long", 1, 2e-5)}})});
  EXPECT_TRUE(run_of(result, "short").is_finished());
  EXPECT_FALSE(run_of(result, "long").left_out.empty());
  EXPECT_TRUE(run_of(result, "long").error_by_degree.empty());
}

TEST(Comparison, RecordsAFailureAndGoesOn) {
  // One midpoint step over several revolutions has no solution connected to its start.
  const auto result = compared(
      kepler_scene(), {series_of("s", {{gauss("too-long", 1, 100.0)}, {gauss("good", 8, 0.2)}})});
  EXPECT_FALSE(run_of(result, "too-long").failure.empty());
  EXPECT_TRUE(run_of(result, "good").is_finished());
}

TEST(Comparison, NeedsASeparationAndDoublePrecision) {
  ComparisonResult result;
  Scene scene = kepler_scene();
  scene.separation.reset();
  EXPECT_THROW(compare(scene, {}, result), Error);
  scene = kepler_scene();
  scene.precision = Precision::extended;
  EXPECT_THROW(compare(scene, {}, result), Error);
}

TEST(CandidateSeries, OfTheDefaultsHaveUniqueLabelsAndFallingSteps) {
  std::set<std::string> labels;
  for (const CandidateSeries& series : candidate_series(kepler_scene())) {
    double last = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : series.candidates) {
      EXPECT_TRUE(labels.insert(candidate.settings.label).second) << candidate.settings.label;
      const double size =
          candidate.settings.step_canonical.value_or(candidate.settings.tolerance.value_or(0));
      EXPECT_LT(size, last);
      EXPECT_GT(size, 0);
      last = size;
    }
  }
  EXPECT_GT(labels.size(), 50U);
}

TEST(CheapestRuns, AreOneASeriesTheFastestFirst) {
  ComparisonResult result;
  result.scene = kepler_scene();
  const auto add = [&](const std::string& label, const std::string& series, double seconds,
                       double error) {
    ComparedRun run;
    run.settings = gauss(label, 8, 0.1);
    run.series = series;
    run.seconds = {seconds, 10 * seconds, seconds};
    run.error_at_formation_m = error;
    result.runs.push_back(run);
  };
  add("a1", "a", 1, 5);
  add("a2", "a", 2, 0.5);
  add("a3", "a", 3, 0.01);
  add("b1", "b", 1.5, 0.9);
  add("c1", "c", 0.1, 2);
  const auto runs = cheapest_runs(result, 1);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]->settings.label, "b1");
  EXPECT_EQ(runs[1]->settings.label, "a2");
  EXPECT_NE(advice(result).find("label = \"b1\""), std::string::npos);
  EXPECT_TRUE(cheapest_runs(result, 1e-3).empty());
  result.scene.comparison.wanted_error_m = 1e-3;
  EXPECT_NE(advice(result).find("no configuration"), std::string::npos);
}

}  // namespace
}  // namespace hamjet
