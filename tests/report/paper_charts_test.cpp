#include <gtest/gtest.h>

#include "../../src/report/drawing/chart.hpp"
#include "../../src/report/paper/energy_conservation_charts.hpp"

// Charts of the paper's studies.

namespace hamjet::io {
namespace {

/// Ten units of time of 3600 s each, in steps of a twentieth, beside fixed ones of a tenth.
EnergyConservationResult sample_conservation() {
  EnergyConservationResult result;
  result.study.units.time_s = 3600;
  for (int k = 0; k <= 200; ++k) {
    EnergyConservationPoint point;
    point.step = k;
    point.time = 0.05 * k;
    point.size = 0.05;
    point.energy_error = 1e-5;
    point.discrete = 1e-20;
    result.points.push_back(point);
  }
  result.predicted_time = 7;
  result.fixed_step.step = 0.1;
  result.fixed_step.energy_errors = {{0, 0}, {5, 1e-6}, {10, 1e-6}};
  return result;
}

TEST(EnergyConservationCharts, AreInHoursAndSeconds) {
  std::vector<Chart> charts = energy_conservation_charts(sample_conservation());
  ASSERT_EQ(charts.size(), 2U);
  for (Chart& chart : charts) {
    fit(chart);
    EXPECT_EQ(chart.x.label, "time (h)");
    EXPECT_DOUBLE_EQ(chart.x.upper, 10);
    ASSERT_FALSE(chart.rules.empty());
    EXPECT_DOUBLE_EQ(chart.rules[0].place, 7);
    EXPECT_EQ(chart.rules[0].title, "predicted to stop");
  }
  // What the method conserves is below the rounding of double precision, and the axis ends there.
  EXPECT_DOUBLE_EQ(charts[0].y.lower, 1e-16);
  EXPECT_EQ(charts[1].y.label, "step size (s)");
  EXPECT_FALSE(charts[1].y.is_logarithmic);
  EXPECT_DOUBLE_EQ(charts[1].curves[0].points[3].second, 180);
  EXPECT_DOUBLE_EQ(charts[1].curves[1].points[0].second, 360);
}

}  // namespace
}  // namespace hamjet::io
