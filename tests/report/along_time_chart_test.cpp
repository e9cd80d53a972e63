#include <gtest/gtest.h>

#include "../../src/report/drawing/along_time_charts.hpp"
#include "comparison_samples.hpp"

// Charts of what was recorded along a run.

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
    ASSERT_EQ(chart.curves[0].ticks.size(), 3U);
    EXPECT_DOUBLE_EQ(chart.curves[0].ticks[1], 2.25 * 927.6 / 60);
    EXPECT_EQ(chart.curves[0].marker_interval, 1);
    ASSERT_EQ(chart.notes.size(), 1U);
    EXPECT_NE(chart.notes[0].find("not looked for: too long"), std::string::npos);
    fit(chart);
    // In double precision all of this is below what rounding leaves.
    EXPECT_EQ(chart.at_limit.size(), precision == Precision::extended ? 0U : 1U);
    if (precision == Precision::extended) {
      EXPECT_LE(chart.y.lower, 1e-33);
    }
  }
  Chart energy = energy_along_time_chart(scene, {run});
  EXPECT_TRUE(energy.curves[0].gaps.empty());
  fit(energy);
  EXPECT_LE(energy.y.lower, 1e-34);
}

}  // namespace
}  // namespace hamjet::io
