#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "../../src/report/comparison/comparison_charts.hpp"
#include "../../src/report/comparison/comparison_view.hpp"
#include "../../src/report/drawing/report_page.hpp"
#include "comparison_samples.hpp"
#include "support/text.hpp"

// Tests what charts show for values out of their range, and how curves, rules and pages are drawn.

namespace hamjet::io {
namespace {

Chart chart_of(std::vector<std::pair<double, double>> points) {
  Chart chart;
  chart.name = "chart";
  chart.y = logarithmic_axis("error");
  ChartCurve curve;
  curve.points = std::move(points);
  chart.curves.push_back(std::move(curve));
  return chart;
}

std::string notes_of(const Chart& chart) {
  std::string notes;
  for (const std::string& note : chart.notes) notes += note + "\n";
  return notes;
}

TEST(ChartFloor, LiftsWhatIsBelowItAndSaysSo) {
  Chart chart = chart_of({{0, 0}, {1, 1e-40}, {2, 1e-10}});
  chart.y.floor = 1e-16;
  chart.y.floor_name = "the rounding";
  fit(chart);
  ASSERT_EQ(chart.curves[0].points.size(), 3U);
  EXPECT_EQ(chart.curves[0].points[0].second, 1e-16);
  EXPECT_EQ(chart.curves[0].points[1].second, 1e-16);
  EXPECT_TRUE(chart.at_limit.empty());
  EXPECT_EQ(notes_of(chart),
            "Values below the floor of 1.0e-16, the rounding, say nothing and are drawn at it: "
            "2.\n");
  ASSERT_EQ(chart.rules.size(), 1U);
  EXPECT_EQ(chart.rules[0].title, "floor: 1.0e-16");
  EXPECT_DOUBLE_EQ(chart.y.lower, 1e-16);
}

// Decades of empty plot are avoided: an axis whose values lie far above the floor does not go down
// to it.
TEST(ChartFloor, DoesNotReachForAnEmptyPart) {
  Chart chart = chart_of({{0, 2e-5}, {2, 1e-3}});
  chart.y.floor = 1e-16;
  fit(chart);
  EXPECT_DOUBLE_EQ(chart.y.lower, 1e-5);
  EXPECT_TRUE(chart.rules.empty() && chart.notes.empty());
}

TEST(ChartValues, StayWithTheirPoints) {
  Chart chart = chart_of({{0, 1}, {1, -1}, {2, 1}});
  chart.curves[0].values = {5, 6, 7};
  chart.value_label = "time (h)";
  fit(chart);
  EXPECT_EQ(chart.curves[0].values, (std::vector<double>{5, 7}));
  const std::string script = gnuplot_script(chart, Drawing::narrow_svg);
  EXPECT_NE(script.find("set cbrange [5:7]"), std::string::npos);
  EXPECT_NE(script.find("set cblabel 'time (h)'"), std::string::npos);
  EXPECT_NE(script.find("2 1 7\n"), std::string::npos);
  EXPECT_NE(script.find("lc palette"), std::string::npos);
}

// Rules of one title look alike and have one entry in the legend.
TEST(ChartRules, AreNamedOnce) {
  Chart chart = chart_of({{0, 1}, {4, 10}});
  chart.rules = {{true, 1, "singular", true}, {true, 2, "singular", true}, {false, 3, "wanted"}};
  fit(chart);
  const std::string script = gnuplot_script(chart, Drawing::wide_svg);
  EXPECT_EQ(test::occurrences(script, "title 'singular'"), 1U);
  EXPECT_EQ(test::occurrences(script, "title 'wanted'"), 1U);
  EXPECT_EQ(test::occurrences(script, "dt (6,4)"), 2U);  // the rules, and their entry
  EXPECT_NE(script.find("2 1\n2 10\n"), std::string::npos);
  EXPECT_NE(script.find("0 3\n4 3\n"), std::string::npos);
}

TEST(ChartSize, ALongLegendTakesNothingFromThePlot) {
  Chart chart = chart_of({{0, 1}, {4, 10}});
  chart.curves.assign(40, chart.curves[0]);
  for (ChartCurve& curve : chart.curves) curve.title = "a method";
  EXPECT_EQ(size_of(chart, Drawing::wide_svg).height, 500U + 40 * 11);
  chart.curves.resize(4);
  EXPECT_EQ(size_of(chart, Drawing::wide_svg).height, 500U);
}

TEST(ReportPage, FollowsTheDarkAndTellsThatTablesScroll) {
  const std::string style = page_style;
  EXPECT_NE(style.find("@media screen and (prefers-color-scheme: dark)"), std::string::npos);
  const auto table = [](std::size_t columns) {
    return table_html("", "<tr>" + header_cells(std::vector<std::string>(columns, "x")) + "</tr>",
                      "");
  };
  EXPECT_NE(table(5).find("The table scrolls sideways"), std::string::npos);
  EXPECT_EQ(table(4).find("The table scrolls sideways"), std::string::npos);
}

/// A finished run of the median time at an error in metres.
ComparedRun timed_run(const std::string& series, double error_m, double seconds) {
  ComparedRun run = sample_run(series, series, 1e-9);
  run.error_at_formation_m = error_m;
  run.seconds = {seconds};
  return run;
}

// Errors beyond the separation of 10 km are not drawn; lines join the unbeaten runs.
TEST(WorkPrecision, ShowsTheRegionThatMatters) {
  ComparisonResult result = sample_comparison();
  result.runs = {timed_run("a", 2e4, 1e-4), timed_run("a", 1, 1e-3),  timed_run("a", 0.5, 9e-3),
                 timed_run("a", 0.1, 5e-3), timed_run("b", 10, 2e-3), timed_run("b", 1e-3, 7e-3)};
  Chart chart = work_precision_chart(result);
  fit(chart);
  EXPECT_EQ(notes_of(chart),
            "Not drawn: runs with an error of the separation, 10 km, or more: 1.\n");
  EXPECT_DOUBLE_EQ(chart.x.upper, 100);
  ASSERT_EQ(chart.rules.size(), 1U);
  EXPECT_EQ(chart.rules[0].place, 1);
  EXPECT_EQ(chart.rules[0].title, "wanted: 1 m");
  // The unbeaten of all, a with its beaten run, b.
  using Points = std::vector<std::pair<double, double>>;
  ASSERT_EQ(chart.curves.size(), 4U);
  EXPECT_TRUE(chart.curves[0].is_background);
  EXPECT_EQ(chart.curves[0].points.size(), 3U);
  EXPECT_EQ(chart.curves[1].points, (Points{{0.1, 5e-3}, {1, 1e-3}}));
  EXPECT_FALSE(chart.curves[2].has_line);
  EXPECT_EQ(chart.curves[2].points, (Points{{0.5, 9e-3}}));
  EXPECT_EQ(chart.curves[3].title, "b");
}

// If no run is better than useless, the useless runs are drawn.
TEST(WorkPrecision, KeepsWhatThereIs) {
  ComparisonResult result = sample_comparison();
  result.runs = {timed_run("a", 2e4, 1e-4), timed_run("b", 3e4, 1e-3)};
  Chart chart = work_precision_chart(result);
  fit(chart);
  EXPECT_EQ(chart.curves.size(), 2U);
  EXPECT_EQ(notes_of(chart), "");
}

TEST(SeriesLook, NoTwoSeriesAreAlikeAndMethodsShareAColour) {
  ComparisonResult result = sample_comparison();
  result.runs.clear();
  result.cost_runs.clear();
  std::vector<std::string> names;
  for (const IntegrationMethod method :
       {IntegrationMethod::gauss, IntegrationMethod::velocity_verlet}) {
    for (int i = 0; i < 12; ++i) {
      ComparedRun run = sample_run(std::to_string(names.size()), "", 1e-9);
      run.settings.method = method;
      if (i % 2 == 1) run.settings.tolerance = 1e-9;
      names.push_back(run.series);
      result.runs.push_back(run);
    }
  }
  std::set<std::tuple<std::size_t, std::size_t, bool>> looks;
  for (const std::string& name : names) {
    const SeriesLook look = series_look(result, name);
    looks.emplace(look.colour, look.shape, look.is_filled);
    EXPECT_EQ(look.colour, std::stoi(name) < 12 ? 0U : 1U);
  }
  EXPECT_EQ(looks.size(), names.size());
}

}  // namespace
}  // namespace hamjet::io
