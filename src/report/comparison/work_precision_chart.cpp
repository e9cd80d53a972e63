#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "comparison_charts.hpp"
#include "comparison_view.hpp"
#include "run_chart_parts.hpp"

// The plot of work and precision.

namespace hamjet::io {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// The points that no other one beats in both error and time, the smallest error first.
Points front(Points points) {
  std::erase_if(points, [](const auto& point) { return std::isnan(point.first); });
  std::sort(points.begin(), points.end());
  Points result;
  for (const auto& point : points) {
    if (result.empty() || point.second < result.back().second) result.push_back(point);
  }
  return result;
}

/// The error from which on a run says nothing of the formation, or has no digit right.
double useless_error(const ComparisonResult& result) {
  return shown_separation_m(result).value_or(1);
}

/// The finished runs of a series; counts those that cannot be claimed.
Points points_of(const ComparisonResult& result, const std::string& series, double smallest,
                 std::size_t& below) {
  Points points;
  for (const ComparedRun& run : result.runs) {
    if (run.series != series || !run.is_finished() || run.seconds.empty()) continue;
    const double error = shown_error(result, run);
    if (is_claimed(error, smallest, below) || !std::isfinite(error)) {
      points.emplace_back(error, run.median_seconds());
    }
  }
  return points;
}

/// Takes out the points at or beyond the useless error, unless that would leave none at all.
void clip(const ComparisonResult& result, std::vector<Points>& series, Chart& chart) {
  const double limit = useless_error(result);
  const auto is_useless = [&](const auto& point) { return !(point.first < limit); };
  std::size_t all = 0;
  std::size_t useless = 0;
  for (const Points& points : series) {
    all += points.size();
    useless += static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_useless));
  }
  if (useless == 0 || useless == all) return;
  for (Points& points : series) std::erase_if(points, is_useless);
  chart.notes.push_back(fmt::format("Not drawn: runs with an error of {} or more: {}.",
                                    has_formation_error(result)
                                        ? "the separation, " + length_text(limit) + ","
                                        : fmt::format("{:g}", limit),
                                    useless));
}

/// A series: its front with a line, and the runs that another one of it beats, markers alone.
void add_series(const ComparisonResult& result, const std::string& name, const Points& points,
                Chart& chart) {
  const SeriesLook look = series_look(result, name);
  ChartCurve curve;
  curve.title = name;
  curve.style = look.shape;
  curve.colour = look.colour;
  curve.is_filled = look.is_filled;
  curve.points = front(points);
  ChartCurve beaten = curve;
  beaten.title.clear();
  beaten.has_line = false;
  beaten.points.clear();
  for (const auto& point : points) {
    if (std::find(curve.points.begin(), curve.points.end(), point) == curve.points.end()) {
      beaten.points.push_back(point);
    }
  }
  chart.curves.push_back(std::move(curve));
  chart.curves.push_back(std::move(beaten));
}

}  // namespace

Chart work_precision_chart(const ComparisonResult& result) {
  Chart chart;
  chart.name = "work-precision";
  chart.title = "Work and precision";
  chart.reading =
      "Each line is one method, each marker one step or tolerance of it: a colour for the method, "
      "a shape for its order, filled for fixed steps and hollow for adaptive ones. Error runs "
      "across, falling to the right; computing time runs upwards, as in the work-precision "
      "diagrams of Hairer, Nørsett and Wanner: at a given error the lowest line is the cheapest "
      "method, and its slope is the price of one more digit (flatter is better: a high order). A "
      "line joins the runs of its method that no other one of it beats in both error and time; "
      "markers off the line are beaten, as those at the rounding floor are. The broad grey line "
      "joins the runs that none of all beats. Times are medians of repeats that were interleaved "
      "over all methods, integration alone, one thread.";
  chart.x = error_axis(result);
  chart.x.is_reversed = true;
  chart.y = run_time_axis();
  // The margins keep markers off the very edge.
  chart.x.margin = chart.y.margin = 0.05;
  const double smallest = smallest_shown_error(result);
  std::size_t below = 0;
  const std::vector<std::string> names = series_names(result.runs);
  std::vector<Points> series;
  for (const std::string& name : names) {
    series.push_back(points_of(result, name, smallest, below));
  }
  clip(result, series, chart);
  Points all;
  for (const Points& points : series) all.insert(all.end(), points.begin(), points.end());
  ChartCurve best;
  best.title = "unbeaten of all";
  best.is_background = true;
  best.has_markers = false;
  best.points = front(std::move(all));
  // A single run has no line.
  if (best.points.size() > 1) chart.curves.push_back(std::move(best));
  for (std::size_t i = 0; i < names.size(); ++i) add_series(result, names[i], series[i], chart);
  add_wanted_error(result, chart);
  note_below(result, smallest, below, chart);
  const auto unfinished = std::count_if(result.runs.begin(), result.runs.end(),
                                        [](const ComparedRun& run) { return !run.is_finished(); });
  if (unfinished > 0) {
    chart.notes.push_back(fmt::format(
        "Runs that failed or were left out have no point: {}; the table names them.", unfinished));
  }
  return chart;
}

}  // namespace hamjet::io
