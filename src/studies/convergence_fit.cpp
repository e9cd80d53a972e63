#include "convergence_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace hamjet {
namespace {

/// Errors less than this many times the smallest of all runs may be round-off.
constexpr double above_floor = 100;
/// Errors above this are not yet governed by the leading term.
constexpr double largest_error = 1e-2;
constexpr std::size_t fewest_points = 3;
constexpr std::size_t most_points = 4;
/// Largest scatter of log10(error) about the line.
constexpr double largest_scatter = 0.1;

struct Point {
  double log_step;
  double log_error;
  std::string label;
};

double smallest_error(const ComparisonResult& result, std::size_t degree) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ComparedRun& run : result.runs) {
    if (run.is_finished()) smallest = std::min(smallest, run.error_by_degree[degree]);
  }
  return smallest;
}

/// The finest runs of a series above the floor, the finest first.
std::vector<Point> usable_points(const ComparisonResult& result, const std::string& series,
                                 std::size_t degree) {
  const double floor = std::max({above_floor * smallest_error(result, degree),
                                 above_floor * std::numeric_limits<double>::epsilon(),
                                 result.smallest_claimed_error(static_cast<int>(degree))});
  std::vector<Point> points;
  for (const ComparedRun& run : result.runs) {
    if (run.series != series || !run.is_finished() || !run.settings.step_canonical) continue;
    const double error = run.error_by_degree[degree];
    if (error < floor || error > largest_error) continue;
    // The step that was taken: the duration is cut into equal ones not longer than asked for.
    const double step = std::abs(result.scene.duration) / static_cast<double>(run.statistics.steps);
    points.push_back({std::log10(step), std::log10(error), run.settings.label});
  }
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.log_step < b.log_step; });
  if (points.size() > most_points) points.resize(most_points);
  return points;
}

struct Line {
  double slope;
  double scatter;
};

Line least_squares(const std::vector<Point>& points) {
  const auto n = static_cast<double>(points.size());
  double x = 0;
  double y = 0;
  for (const Point& point : points) {
    x += point.log_step / n;
    y += point.log_error / n;
  }
  double xx = 0;
  double xy = 0;
  for (const Point& point : points) {
    xx += (point.log_step - x) * (point.log_step - x);
    xy += (point.log_step - x) * (point.log_error - y);
  }
  Line line{xy / xx, 0};
  for (const Point& point : points) {
    line.scatter =
        std::max(line.scatter, std::abs(point.log_error - y - line.slope * (point.log_step - x)));
  }
  return line;
}

std::optional<ConvergenceFit> fit(const ComparisonResult& result, const CandidateSeries& series,
                                  int degree) {
  const auto points = usable_points(result, series.name, static_cast<std::size_t>(degree));
  if (points.size() < fewest_points) return std::nullopt;
  const Line line = least_squares(points);
  if (line.scatter > largest_scatter) return std::nullopt;
  ConvergenceFit fit{series.name, degree, line.slope, series.order, {}};
  for (const Point& point : points) fit.labels.push_back(point.label);
  return fit;
}

}  // namespace

std::vector<ConvergenceFit> convergence_fits(const ComparisonResult& result,
                                             const std::vector<CandidateSeries>& series) {
  std::vector<ConvergenceFit> fits;
  for (const CandidateSeries& one : series) {
    if (one.order == 0) continue;
    for (const int degree : std::set<int>{0, result.scene.order}) {
      if (auto found = fit(result, one, degree)) fits.push_back(std::move(*found));
    }
  }
  return fits;
}

}  // namespace hamjet
