#include <gtest/gtest.h>

#include <set>
#include <string>

#include "../../src/report/formation/transfer_charts.hpp"
#include "../../src/report/formation/transfer_view.hpp"
#include "../../src/report/formation/validity_view.hpp"
#include "../../src/text/html_text.hpp"
#include "plot_program.hpp"
#include "support/text.hpp"
#include "transfer_samples.hpp"

// report.html of the studies of relative motion, and its charts.

namespace hamjet::io {
namespace {

std::string page_of(const StudyReport& report) {
  for (const ReportFile& file : report.files) {
    if (file.path == "report.html") return file.content;
  }
  ADD_FAILURE() << "no page";
  return "";
}

const ChartCurve* curve_named(const Chart& chart, const std::string& title) {
  for (const ChartCurve& curve : chart.curves) {
    if (curve.title == title) return &curve;
  }
  return nullptr;
}

TEST(TransferPage, BeginsWithTheLeastVelocityChangeItsTimeAndTheMisses) {
  const TransferResult result = sample_transfer();
  const std::string verdict = transfer_verdict(result);
  // Point 6: 1.0001 (sqrt(1 + 1/9 + 0.01) + sqrt(0.04 + 1/49 + 1)) times 2 m/s = 4.178 m/s, after
  // 6 units of 927.6 s.
  EXPECT_EQ(verdict,
            "The least velocity change found at the listed times is 4.178 m/s, for a transfer time "
            "of 5565.6 s (92.8 "
            "min): flown with the full equations of motion the deputy misses its place by 33.3 μm "
            "after refinement (300 mm by order 2 alone), with the linear answer by 1.23 km. "
            "That is the last of the times searched: beyond it the change may fall further, which "
            "longer times would show. Of 6 times it compares 4 and leaves out 1 nearer to a "
            "singularity than the margin, 1 without an answer, which transfers.csv has, marked. "
            "Why a time has no answer is in the column failure; one a little earlier or later may "
            "have one. "
            "Between the listed times nothing was searched.");
  const std::string page = page_of(
      transfer_report(with_validity(result), sample_trajectory(), sample_transfer_origin()));
  const std::size_t place = page.find(escape_html(verdict));
  ASSERT_NE(place, std::string::npos);
  EXPECT_LT(place, page.find("<main>"));
  EXPECT_NE(page.find("A sample &amp; its &lt;title&gt;"), std::string::npos);
  EXPECT_EQ(test::occurrences(page, "<script"), 0U);
  EXPECT_EQ(test::occurrences(page, "<b>"), 0U);
  EXPECT_EQ(test::occurrences(page, "http"), 0U);
  EXPECT_NE(page.find("(+0.000000, +0.600000, -0.800000)"), std::string::npos);
  EXPECT_NE(page.find("no kind of generating function exists"), std::string::npos);
}

TEST(TransferPage, WithoutGnuplotTheTablesAreThere) {
  const StudyReport report =
      transfer_report(sample_transfer(), sample_trajectory(), sample_transfer_origin());
  ASSERT_TRUE(report.drawing_problem);
  const std::string page = page_of(report);
  EXPECT_EQ(test::occurrences(page, "is not installed"), 1U);
  EXPECT_EQ(test::occurrences(page, "<svg"), 0U);
  EXPECT_NE(page.find("Velocity changes for the transfer in 5565.6 s"), std::string::npos);
}

TEST(TransferPage, HasEveryPlotInTwoWidthsWithUniqueIds) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const StudyReport report = transfer_report(with_validity(sample_transfer()), sample_trajectory(),
                                             sample_transfer_origin("gnuplot"));
  EXPECT_FALSE(report.drawing_problem) << *report.drawing_problem;
  const std::string page = page_of(report);
  // Velocity change, three projections, misses, conditions, validity along time and order.
  // The projections are panels beside one another, narrow in every window.
  EXPECT_EQ(test::occurrences(page, "<svg"), 2 * 5U + 3);
  EXPECT_EQ(test::occurrences(page, "<div class=\"panels\">"), 1U);
  for (const char* name : {"velocity-change", "relative-tr", "relative-tn", "relative-rn",
                           "miss-time", "kind-conditions", "validity-time", "validity-order"}) {
    EXPECT_NE(page.find("id=\"figure-" + std::string(name) + "\""), std::string::npos) << name;
  }
  std::set<std::string> ids;
  std::size_t given = 0;
  for (std::size_t i = page.find(" id=\""); i != std::string::npos; i = page.find(" id=\"", i)) {
    i += 5;
    ids.insert(page.substr(i, page.find('"', i) - i));
    ++given;
  }
  EXPECT_EQ(ids.size(), given);
  EXPECT_EQ(
      test::occurrences(
          page_of(validity_report(sample_validity(), sample_transfer_origin("gnuplot"))), "<svg"),
      4U);
}

TEST(TransferPage, ValidityBeginsWithTheSeparations) {
  const std::string verdict = validity_verdict(sample_validity());
  EXPECT_EQ(verdict,
            "After 1855.2 s (30.9 min) the polynomial is right to 1 m up to a separation of 0 m in "
            "order 1 and at least 500 km in order 2, proved by flying deputies with "
            "velocities as seen from the turning RTN axes. At least: nothing further away was "
            "tried. 0 m: no separation could be proved, "
            "because those deputies missed by more than the tolerance however near they were. The "
            "flights themselves are right to 1 μm; a finer integrator, or a larger tolerance, may "
            "prove some.");
  const std::string page = page_of(validity_report(sample_validity(), sample_transfer_origin()));
  EXPECT_LT(page.find(verdict), page.find("<main>"));
}

/// A canonical unit of time of the sample, in the charts' minutes.
constexpr double minutes = 927.6 / 60;

TEST(TransferCharts, ShadeTheMarginsAndMarkWhatIsDoubtful) {
  Chart chart = velocity_change_chart(sample_transfer());
  fit(chart);
  ASSERT_EQ(chart.bands.size(), 1U);  // the other one lies behind the last transfer time
  EXPECT_DOUBLE_EQ(chart.bands[0].from, 2.96 * minutes);
  EXPECT_DOUBLE_EQ(chart.bands[0].to, 3.06 * minutes);
  const ChartCurve* total = curve_named(chart, "both impulses");
  ASSERT_NE(total, nullptr);
  EXPECT_EQ(total->points.size(), 5U);
  EXPECT_EQ(total->gaps.size(), 1U);
  const ChartCurve* near = curve_named(chart, "near a singularity");
  ASSERT_NE(near, nullptr);
  ASSERT_EQ(near->points.size(), 1U);
  EXPECT_FALSE(near->is_filled);
  EXPECT_EQ(curve_named(chart, "order 2 misses by more than 1 m"), nullptr);
  ASSERT_EQ(chart.rules.size(), 1U);
  EXPECT_DOUBLE_EQ(chart.rules[0].place, 6 * minutes);
  EXPECT_NE(chart.reading.find("Shaded"), std::string::npos);
  const std::string script = gnuplot_script(chart, Drawing::wide_svg);
  EXPECT_EQ(test::occurrences(script, "set object rectangle"), 1U);
  EXPECT_NE(script.find("behind"), std::string::npos);
}

// Even without the point that has no answer, the time at which F1 does not exist breaks the lines.
TEST(TransferCharts, LinesAreBrokenAtSingularTimesAndForWantOfAnAnswer) {
  TransferResult result = sample_transfer();
  EXPECT_EQ(velocity_change_chart(result).notes,
            (std::vector<std::string>{"Lines are also broken at transfer times without an answer: "
                                      "1; the table says why."}));
  std::erase_if(result.points, [](const auto& point) { return shown_answer(point) == nullptr; });
  const Chart chart = velocity_change_chart(result);
  EXPECT_TRUE(chart.notes.empty());
  EXPECT_EQ(curve_named(chart, "both impulses")->gaps.size(), 1U);
}

TEST(TransferCharts, BandsEndWhereTheAxisDoes) {
  Chart chart;
  ChartCurve curve;
  curve.points = {{0, 1}, {10, 2}};
  chart.curves.push_back(curve);
  chart.bands = {{-5, 1}, {4, 3}, {9, 12}, {11, 12}};
  fit(chart);
  ASSERT_EQ(chart.bands.size(), 3U);
  EXPECT_EQ(chart.bands[0].from, 0);
  EXPECT_EQ(chart.bands[1].from, 3);
  EXPECT_EQ(chart.bands[1].to, 4);
  EXPECT_EQ(chart.bands[2].to, 10);
}

TEST(TransferCharts, ConditionsAreTickedWhereAKindFails) {
  Chart chart = condition_chart(sample_transfer());
  const ChartCurve* f1 = curve_named(chart, "F1");
  const ChartCurve* f2 = curve_named(chart, "F2");
  ASSERT_TRUE(f1 != nullptr && f2 != nullptr);
  EXPECT_EQ(f1->ticks.size(), 2U);
  ASSERT_EQ(f2->ticks.size(), 1U);
  EXPECT_DOUBLE_EQ(f2->ticks[0], 1.5 * minutes);
  const ChartCurve* best = curve_named(chart, "best of all 64");
  ASSERT_NE(best, nullptr);
  for (const auto& point : best->points) EXPECT_DOUBLE_EQ(point.second, 2 + 1.0 / 3);
}

// All panels show one span, so that their amplitudes can be compared by eye.
TEST(TransferCharts, ProjectionsHaveEqualScalesAndTimeAsColour) {
  auto charts = relative_trajectory_charts(sample_trajectory(), 3600);
  ASSERT_EQ(charts.size(), 3U);
  for (Chart& chart : charts) {
    EXPECT_TRUE(chart.is_isometric && chart.is_panel);
    fit(chart);
    // T goes from -8 km to 100 m.
    EXPECT_NEAR(chart.x.upper - chart.x.lower, 8.1 * 1.1, 1e-9);
    EXPECT_NEAR(chart.y.upper - chart.y.lower, 8.1 * 1.1, 1e-9);
    // Six canonical units of an hour.
    EXPECT_EQ(chart.value_label, "time (h)");
    ASSERT_EQ(chart.curves[0].values.size(), 11U);
    EXPECT_DOUBLE_EQ(chart.curves[0].values[10], 6);
  }
  EXPECT_EQ(charts[0].x.label, "T (km)");
  EXPECT_EQ(charts[0].y.label, "R (km)");
  EXPECT_EQ(charts[1].y.label, "N (km)");
  EXPECT_EQ(charts[2].x.label, "R (km)");
  EXPECT_DOUBLE_EQ(charts[0].curves[0].points[0].first, -8);
  EXPECT_DOUBLE_EQ(charts[2].curves[0].points[10].second, 0);
  // The parabola 100 k (10 - k) m has its top at k = 5.
  ASSERT_EQ(charts[0].notes.size(), 1U);
  EXPECT_EQ(charts[0].notes[0],
            "Of the deputy: R from 0 m to 2.5 km (amplitude 1.25 km); T from -8 km to 100 m "
            "(amplitude 4.05 km); N from 0 m to 6 km (amplitude 3 km).");
}

TEST(TransferCharts, TheRendezvousIsDrawnBesideTheDeputyByItself) {
  RelativeTrajectory trajectory = sample_trajectory();
  RelativeState state;
  state.position_m = {500, -9000, 0};
  trajectory.unchanged = {state, state};
  const Chart chart = rendezvous_chart(trajectory);
  EXPECT_TRUE(chart.is_isometric);
  EXPECT_EQ(chart.x.label, "T (km)");
  EXPECT_EQ(chart.y.label, "R (km)");
  ASSERT_EQ(chart.curves.size(), 5U);
  EXPECT_EQ(chart.curves[0].title, "by itself");
  EXPECT_EQ(chart.curves[0].points[0], std::pair(-9.0, 0.5));
  EXPECT_EQ(chart.curves[1].points.size(), trajectory.states.size());
  EXPECT_EQ(chart.curves[4].title, "chief");
  EXPECT_EQ(chart.curves[4].points[0], std::pair(0.0, 0.0));
}

// A deputy 500 km ahead that moves by some km would be a dot beside its chief, and so would a
// transfer beside a drift of 500 km.
TEST(TransferCharts, WhatMovesIsNoDot) {
  RelativeTrajectory far = sample_trajectory();
  for (RelativeState& state : far.states) state.position_m.y() += 500e3;
  auto charts = relative_trajectory_charts(far, 3600);
  fit(charts[0]);
  EXPECT_NEAR(charts[0].x.upper - charts[0].x.lower, 8.1 * 1.1, 1e-9);
  for (const ChartCurve& curve : charts[0].curves) EXPECT_NE(curve.title, "chief");
  EXPECT_NE(charts[0].notes[0].find("the chief, 496 km away, is not shown"), std::string::npos)
      << charts[0].notes[0];
  Chart rendezvous = rendezvous_chart(far);
  EXPECT_NE(rendezvous.title.find("the chief, 496 km away, is not shown"), std::string::npos);
  fit(rendezvous);
  EXPECT_LT(rendezvous.x.upper - rendezvous.x.lower, 9);

  RelativeTrajectory drifting = sample_trajectory();
  RelativeState state = drifting.states.front();
  for (int k = 0; k <= 100; ++k) {
    drifting.unchanged.push_back(state);
    state.position_m.y() -= 5000;
  }
  Chart chart = rendezvous_chart(drifting);
  EXPECT_EQ(chart.curves[0].title, "by itself, at first");
  EXPECT_NE(chart.notes[0].find("By itself it ends 508 km from its chief"), std::string::npos)
      << chart.notes[0];
  fit(chart);
  EXPECT_LT(chart.x.upper - chart.x.lower, 6 * 8.1);
}

// One tick alone does not show the scale of an axis.
TEST(TransferCharts, EachAxisHasThreeTicks) {
  RelativeTrajectory trajectory = sample_trajectory();
  for (RelativeState& state : trajectory.states) state.position_m.x() *= 0.64;  // to 1.6 km
  Chart chart = rendezvous_chart(trajectory);
  fit(chart);
  const std::string script = gnuplot_script(chart, Drawing::wide_svg);
  EXPECT_NE(script.find("set xtics 1\nset ytics 0.5\n"), std::string::npos) << script;
}

// The linear answer is as good as the others for near deputies, and would hide the line below.
TEST(TransferCharts, TheLinearAnswerLeavesTheOthersVisible) {
  const Chart chart = velocity_change_chart(sample_transfer());
  const ChartCurve* linear = curve_named(chart, "both, linear answer");
  ASSERT_NE(linear, nullptr);
  EXPECT_FALSE(linear->has_line || linear->is_filled);
  EXPECT_TRUE(linear->has_markers);
  EXPECT_TRUE(curve_named(chart, "both impulses")->has_line);
}

TEST(TransferCharts, ValidityLinesAreProvedAndHollowMarkersPredicted) {
  const Chart chart = validity_time_chart(sample_validity());
  ASSERT_EQ(chart.curves.size(), 4U);
  EXPECT_TRUE(chart.curves[0].has_line && chart.curves[0].is_filled);
  EXPECT_FALSE(chart.curves[1].has_line || chart.curves[1].is_filled);
  EXPECT_EQ(chart.curves[2].points[1].second, 5e5);
  EXPECT_EQ(chart.curves[3].points[1].second, 2e4);
  ASSERT_EQ(chart.notes.size(), 1U);
  EXPECT_NE(chart.notes[0].find("lower bounds"), std::string::npos);
  EXPECT_EQ(validity_order_chart(sample_validity()).curves.size(), 4U);
}

}  // namespace
}  // namespace hamjet::io
