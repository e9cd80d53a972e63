#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "../../src/report/drawing/along_time_charts.hpp"
#include "comparison_samples.hpp"

// Charts of the quantities recorded along a run.

namespace hamjet::io {
namespace {

// Between two points with a singular time the line is broken, and the axis reaches as far down as
// the precision does.
TEST(AlongTimeChart, BreaksAtSingularTimesAndFollowsThePrecision) {
  Scene scene = sample_comparison().scene;
  scene.duration = 4;
  RunAlongTime run{"gauss", "", {}, {0.5, 2.25, 2.75}, "too long"};
  for (int i = 0; i <= 4; ++i) run.points.push_back({1.0 * i, 1e-33 * (i + 1), 3, 1e-34});
  for (const Precision precision : {Precision::double_precision, Precision::extended}) {
    scene.precision = precision;
    Chart chart = exactness_along_time_chart(scene, parse_kind("F1", 3), {run});
    ASSERT_EQ(chart.curves.size(), 1U);
    EXPECT_EQ(chart.curves[0].gaps, (std::vector<std::size_t>{1, 3}));
    // Four units of 927.6 s are an hour and two minutes: the axis is in minutes.
    EXPECT_EQ(chart.x.label, "time (min)");
    EXPECT_DOUBLE_EQ(chart.curves[0].points.back().first, 4 * 927.6 / 60);
    ASSERT_EQ(chart.rules.size(), 3U);
    EXPECT_TRUE(chart.rules[1].is_vertical);
    EXPECT_DOUBLE_EQ(chart.rules[1].place, 2.25 * 927.6 / 60);
    EXPECT_EQ(chart.curves[0].marker_interval, 1);
    ASSERT_EQ(chart.notes.size(), 2U);
    EXPECT_NE(chart.notes[0].find("not looked for: too long"), std::string::npos);
    EXPECT_EQ(chart.notes[1],
              "Lines are broken at the vertical lines, where the kind does not exist.");
    fit(chart);
    // In double precision all these values are below the rounding floor.
    if (precision == Precision::extended) {
      EXPECT_EQ(chart.notes.size(), 2U);
      EXPECT_LE(chart.y.lower, 1e-33);
    } else {
      ASSERT_EQ(chart.notes.size(), 3U);
      EXPECT_NE(chart.notes[2].find("the rounding of double precision"), std::string::npos);
      EXPECT_NE(chart.notes[2].find("drawn at it: 5."), std::string::npos);
      EXPECT_DOUBLE_EQ(chart.y.lower, 1e-16);
    }
  }
  Chart energy = energy_along_time_chart(scene, {run});
  EXPECT_TRUE(energy.curves[0].gaps.empty());
  EXPECT_TRUE(energy.rules.empty());
  fit(energy);
  EXPECT_DOUBLE_EQ(energy.y.lower, 1e-34);
}

// An orbit of a semi-major axis of 1 closes in 2 pi.
TEST(AlongTimeChart, CountsRevolutionsAtTheTop) {
  Scene scene = sample_comparison().scene;
  scene.system = {};
  scene.system.model = SystemModel::kepler;
  scene.nominal = {1, 0, 0, 0, 1, 0};
  scene.duration = 4 * std::numbers::pi;
  const double hours = 4 * std::numbers::pi * scene.units.time_s / 3600;
  Chart chart = energy_along_time_chart(scene, {{"gauss", "", {{1, {}, 1, 1e-9}}}});
  fit(chart);
  EXPECT_EQ(chart.x.label, "time (h)");
  EXPECT_NEAR(chart.x.top_unit, hours / 2, 1e-12);
  EXPECT_EQ(chart.x.top_label, "revolutions");
  const std::string script = gnuplot_script(chart, Drawing::wide_svg);
  EXPECT_NE(script.find("set x2label 'revolutions'"), std::string::npos);
  const std::string range = "set x2range [0:";
  ASSERT_NE(script.find(range), std::string::npos);
  EXPECT_NEAR(std::stod(script.substr(script.find(range) + range.size())), 2, 1e-12);
  EXPECT_EQ(script.find("set title"), std::string::npos);
  EXPECT_NE(gnuplot_script(chart, Drawing::png).find("set title 'Energy error along time'"),
            std::string::npos);
}

// The times are those of the flow, the same for all integrators, and are drawn once.
TEST(AlongTimeChart, DrawsASingularTimeOnceAndCountsWhatIsMissing) {
  Scene scene = sample_comparison().scene;
  scene.duration = 4;
  std::vector<RunAlongTime> runs = {{"short", "", {{1, 1e-9, 3, 0}}, {0.5}},
                                    {"long", "", {{1, 1e-9, 3, 0}, {3, {}, 3, 0}}, {0.5, 2.25}}};
  Chart chart = exactness_along_time_chart(scene, parse_kind("F1", 3), runs);
  ASSERT_EQ(chart.rules.size(), 2U);
  EXPECT_EQ(chart.rules[1].title, "kind does not exist");
  ASSERT_EQ(chart.notes.size(), 2U);
  EXPECT_EQ(chart.notes[1],
            "Lines are broken at points where the residual could not be computed: 1.");
}

}  // namespace
}  // namespace hamjet::io
