#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../../src/report/comparison/comparison_charts.hpp"
#include "../../src/report/comparison/comparison_view.hpp"
#include "comparison_samples.hpp"
#include "hamjet/error.hpp"
#include "plot_program.hpp"
#include "support/temporary_directory.hpp"
#include "support/text.hpp"

// Tests report.html and the files of its plots.

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

/// All values that stand behind `before` up to the next `end`.
std::vector<std::string> values(const std::string& text, const std::string& before, char end) {
  std::vector<std::string> found;
  for (std::size_t i = text.find(before); i != std::string::npos; i = text.find(before, i)) {
    i += before.size();
    found.push_back(text.substr(i, text.find(end, i) - i));
  }
  return found;
}

/// Whether every element is closed in its order; void ones as in `/>`.
bool is_balanced(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t i = xml.find('<'); i != std::string::npos; i = xml.find('<', i)) {
    const std::size_t close = xml.find('>', i);
    if (close == std::string::npos) return false;
    const std::string tag = xml.substr(i + 1, close - i - 1);
    const std::string name =
        tag.substr(tag[0] == '/', tag.find_first_of(" \t\n/>", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = close;
  }
  return open.empty();
}

TEST(ComparisonPage, HoldsTheVerdictAndEscapesTheScene) {
  ComparisonResult result = sample_comparison();
  result.scene.title = "<script>alert('x')</script> & more";
  result.runs[0].settings.label = "<img src=x>";
  result.runs[4].failure = "<b>bold</b>";
  for (ComparedRun& run : result.runs) {
    if (run.series == "fehlberg78") run.series = "a' . system(\"x\") `y` id='z' <i>";
  }
  std::optional<std::string> problem;
  const std::string page = comparison_html(result, sample_origin(), problem);
  EXPECT_NE(page.find(escape_html(verdict(result))), std::string::npos);
  EXPECT_EQ(test::occurrences(page, "<script"), 0U);
  EXPECT_EQ(test::occurrences(page, "<img"), 0U);
  EXPECT_EQ(test::occurrences(page, "<b>"), 0U);
  EXPECT_EQ(test::occurrences(page, "<i>"), 0U);
  EXPECT_NE(page.find("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; more"),
            std::string::npos);
  EXPECT_NE(page.find(escape_html(sample_origin().command)), std::string::npos);
  EXPECT_NE(page.find(escape_html(sample_origin().processor)), std::string::npos);
  EXPECT_NE(page.find(sample_origin().date), std::string::npos);
  EXPECT_NE(page.find("would exceed the time budget"), std::string::npos);
}

TEST(ComparisonPage, APartialResultSaysSo) {
  ComparisonResult result = sample_comparison();
  ReportOrigin origin = sample_origin();
  origin.gnuplot = "/nonexistent/gnuplot";
  std::optional<std::string> problem;
  EXPECT_EQ(comparison_html(result, origin, problem).find("Partial result"), std::string::npos);
  result.is_complete = false;
  EXPECT_NE(comparison_html(result, origin, problem).find("Partial result"), std::string::npos);
}

TEST(ComparisonPage, AnEmptyPartialResultIsAPageToo) {
  ComparisonResult result;
  result.scene = sample_comparison().scene;
  std::optional<std::string> problem;
  const std::string page = comparison_html(result, sample_origin(), problem);
  EXPECT_NE(page.find("Partial result"), std::string::npos);
  EXPECT_EQ(test::occurrences(page, "<svg"), 0U);
  EXPECT_FALSE(problem);
  EXPECT_TRUE(read_comparison_runs(comparison_json(result, sample_origin())).runs.empty());
  EXPECT_FALSE(comparison_table(result).empty());
}

TEST(ComparisonPage, WithoutGnuplotTheTablesAreThereAndOneLineSaysWhy) {
  const test::TemporaryDirectory folder;
  ReportOrigin origin = sample_origin();
  origin.gnuplot = "/nonexistent/gnuplot";
  OutputDirectory output(folder.path() / "out");
  const ComparisonReport report = make_report(sample_comparison(), origin, PlotFormat::pdf);
  const std::string written = write_report(report, output);
  const auto& line = report.drawing_problem;
  ASSERT_TRUE(line);
  EXPECT_NE(line->find("/nonexistent/gnuplot is not installed"), std::string::npos);
  EXPECT_EQ(line->find('\n'), std::string::npos);
  const std::string page = test::content(folder.path() / "out" / "report.html");
  EXPECT_EQ(test::occurrences(page, "is not installed"), 1U);
  EXPECT_NE(page.find("gauss4-0.05"), std::string::npos);
  EXPECT_EQ(test::occurrences(page, "<svg"), 0U);
  EXPECT_EQ(test::content(folder.path() / "out" / "compare.csv"),
            comparison_csv(sample_comparison()));
  EXPECT_EQ(test::content(folder.path() / "out" / "compare.json"), written);
  auto json = nlohmann::json::parse(written);
  EXPECT_EQ(json["files"].size(), 2U);
  json.erase("files");
  json.erase("crc32");
  EXPECT_EQ(json, nlohmann::json::parse(comparison_json(sample_comparison(), origin)));
  EXPECT_FALSE(fs::exists(folder.path() / "out" / "plots"));
}

TEST(ComparisonPage, WhatIsNoDrawingIsNotBelieved) {
  const test::TemporaryDirectory folder;
  const fs::path program = folder.path() / "gnuplot";
  std::ofstream(program) << "#!/bin/sh\ncat >/dev/null\necho hello\n";
  fs::permissions(program, fs::perms::owner_all);
  ReportOrigin origin = sample_origin();
  origin.gnuplot = program.string();
  const ComparisonReport report = make_report(sample_comparison(), origin, PlotFormat::png);
  ASSERT_TRUE(report.drawing_problem);
  EXPECT_NE(report.drawing_problem->find("no plot"), std::string::npos);
  EXPECT_EQ(report.files.size(), 3U);
}

TEST(ComparisonPage, PlotsAreWellFormedAndTheirIdsUnique) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  std::optional<std::string> problem;
  const std::string page = comparison_html(sample_comparison(), sample_origin(), problem);
  EXPECT_FALSE(problem) << *problem;
  EXPECT_EQ(test::occurrences(page, "<svg"), 2 * comparison_charts(sample_comparison()).size());
  const auto plots = values(page, "<svg", '\f');
  for (std::string plot : plots) {
    plot = "<svg" + plot.substr(0, plot.find("</svg>") + 6);
    EXPECT_TRUE(is_balanced(plot)) << plot.substr(0, 300);
  }
  std::set<std::string> ids;
  std::size_t given = 0;
  for (const auto& [before, end] : {std::pair{" id='", '\''}, std::pair{" id=\"", '"'}}) {
    for (const std::string& id : values(page, before, end)) {
      ids.insert(id);
      ++given;
    }
  }
  EXPECT_GT(given, 100U);
  EXPECT_EQ(ids.size(), given);
  for (const std::string& reference : values(page, "href='#", '\'')) {
    EXPECT_TRUE(ids.count(reference)) << reference;
  }
}

TEST(ComparisonPage, PlotsGoToFilesOnRequestAndEarlierOnesAreRemoved) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const test::TemporaryDirectory folder;
  for (const auto& [format, extension, start] : {std::tuple{PlotFormat::pdf, ".pdf", "%PDF"},
                                                 std::tuple{PlotFormat::png, ".png", "\x89PNG"}}) {
    OutputDirectory output(folder.path());
    const ComparisonReport report = make_report(sample_comparison(), sample_origin(), format);
    EXPECT_FALSE(report.drawing_problem);
    write_report(report, output);
    std::size_t files = 0;
    for (const auto& file : fs::directory_iterator(folder.path() / "plots")) {
      EXPECT_EQ(file.path().extension(), extension);
      EXPECT_EQ(test::content(file.path()).substr(0, 4), start);
      ++files;
    }
    EXPECT_EQ(files, comparison_charts(sample_comparison()).size());
  }
}

TEST(ComparisonCharts, AccountForEveryPoint) {
  ComparisonResult result = sample_comparison();
  result.runs[0].error_at_formation_m = 0;
  for (const Chart& chart : comparison_charts(result)) {
    SCOPED_TRACE(chart.name);
    std::size_t drawn = 0;
    for (const ChartCurve& curve : chart.curves) {
      for (const auto& [x, y] : curve.points) {
        EXPECT_TRUE(x >= chart.x.lower && x <= chart.x.upper) << x;
        EXPECT_TRUE(y >= chart.y.lower && y <= chart.y.upper) << y;
        ++drawn;
      }
    }
    std::string notes;
    for (const std::string& note : chart.notes) notes += note;
    if (chart.name == "work-precision") {
      // Of four finished runs one has an error of zero, and one that of the separation.
      EXPECT_EQ(drawn, 2U);
      EXPECT_NE(notes.find("10 km, or more: 1."), std::string::npos) << notes;
      EXPECT_NE(notes.find("exactly zero: 1."), std::string::npos) << notes;
      EXPECT_NE(notes.find("left out have no point: 2"), std::string::npos) << notes;
    }
    if (chart.name == "energy-time") {
      // Two of them are zero, which is below the rounding.
      EXPECT_EQ(drawn, 41U);
      EXPECT_TRUE(chart.at_limit.empty());
      EXPECT_NE(notes.find("are drawn at it: 2."), std::string::npos) << notes;
    }
    if (chart.name == "convergence") {
      // The fitted line is drawn, its two points are filled, and the third run is hollow.
      ASSERT_EQ(chart.curves.size(), 3U);
      EXPECT_TRUE(chart.curves[0].has_line);
      ASSERT_EQ(chart.curves[0].points.size(), 2U);
      EXPECT_DOUBLE_EQ(chart.curves[0].points[0].first, 0.05 * result.scene.units.time_s);
      EXPECT_NEAR(std::log2(chart.curves[0].points[1].second / chart.curves[0].points[0].second),
                  7.97, 1e-9);
      EXPECT_TRUE(chart.curves[1].is_filled);
      EXPECT_EQ(chart.curves[1].points.size(), 2U);
      EXPECT_FALSE(chart.curves[2].is_filled);
      EXPECT_EQ(chart.curves[2].points.size(), 1U);
    }
    if (chart.name == "exactness-time") {
      EXPECT_EQ(drawn, 39U);
      ASSERT_FALSE(chart.rules.empty());
      // In hours: 31.4 units of 927.6 s are eight.
      EXPECT_DOUBLE_EQ(chart.rules[0].place, 0.7 * 927.6 / 3600);
    }
  }
}

}  // namespace
}  // namespace hamjet::io
