#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../drawing/along_time_charts.hpp"
#include "comparison_charts.hpp"
#include "comparison_view.hpp"

// Plots with one point a run.

namespace hamjet::io {
namespace {

ChartAxis error_axis(const ComparisonResult& result) {
  return logarithmic_axis(shown_error_name(result),
                          has_formation_error(result) ? AxisUnit::metres : AxisUnit::power);
}

ChartAxis time_axis() { return logarithmic_axis("time of integration", AxisUnit::seconds); }

/// Whether the error may be shown; counts those that are the reference's as much as the run's.
bool is_claimed(double error, double smallest, std::size_t& below) {
  if (error > 0 && !(error < smallest)) return true;
  if (std::isfinite(error)) ++below;
  return false;
}

void note_below(const ComparisonResult& result, double smallest, std::size_t below, Chart& chart) {
  if (below == 0) return;
  chart.notes.push_back(fmt::format(
      "Not drawn: runs with an error below {}, ten times the reference's uncertainty, "
      "or of exactly zero: {}.",
      has_formation_error(result) ? length_text(smallest) : fmt::format("{:.1e}", smallest),
      below));
}

/// A chart of one point a run: its error across, and upwards what `measure` gives, coloured by
/// corner.
template <class Measure>
Chart corner_chart(const ComparisonResult& result, std::string label, Measure measure) {
  Chart chart;
  chart.x = error_axis(result);
  chart.x.margin = 0.5;
  chart.y = logarithmic_axis(std::move(label));
  chart.y.margin = 1.2;
  const double smallest = smallest_shown_error(result);
  std::size_t below = 0;
  std::array<ChartCurve, 5> curves;
  // Shapes differ as the colours do: square, circle, triangle, diamond, pentagon.
  constexpr std::array<std::size_t, 4> styles = {3, 4, 1, 5};
  for (std::size_t c = 0; c < 5; ++c) {
    curves[c].has_line = false;
    curves[c].style = c < 4 ? styles[c] : 7;
    curves[c].title = c < 4 ? corner_text(static_cast<Corner>(c)) : "not a full map";
  }
  for (const ComparedRun& run : result.runs) {
    if (!run.is_finished()) continue;
    const std::optional<double> value = measure(run);
    if (!value) continue;
    const double error = shown_error(result, run);
    if (!is_claimed(error, smallest, below)) continue;
    curves[run.corner ? static_cast<std::size_t>(*run.corner) : 4].points.emplace_back(error,
                                                                                       *value);
  }
  chart.curves.assign(curves.begin(), curves.end());
  note_below(result, smallest, below, chart);
  chart.rules.push_back({false, largest_exact_defect});
  if (has_formation_error(result) && result.scene.comparison.wanted_error_m > 0) {
    chart.rules.push_back({true, result.scene.comparison.wanted_error_m});
  }
  const auto name = [](Corner corner) { return std::string(corner_text(corner)); };
  chart.corners = {{false, false, name(Corner::exact_and_accurate)},
                   {true, false, name(Corner::exact_but_wrong)},
                   {false, true, name(Corner::accurate_not_symplectic)},
                   {true, true, name(Corner::neither)}};
  return chart;
}

}  // namespace

Chart work_precision_chart(const ComparisonResult& result) {
  Chart chart;
  chart.name = "work-precision";
  chart.title = "Work and precision";
  chart.reading =
      "Each line is one method, each marker one step or tolerance of it. Error runs across, "
      "falling "
      "to the right; computing time runs upwards, as in the work-precision diagrams of Hairer, "
      "Nørsett and Wanner: at a given error the lowest line is the cheapest method, and its slope "
      "is the price of one more digit (flatter is better: a high order). A line that turns upwards "
      "at its right end has reached its rounding floor. Times are medians of repeats that were "
      "interleaved over all methods, integration alone, one thread.";
  chart.x = error_axis(result);
  chart.x.is_reversed = true;
  chart.y = time_axis();
  // The margins keep markers off the very edge.
  chart.x.margin = chart.y.margin = 0.05;
  const double smallest = smallest_shown_error(result);
  std::size_t below = 0;
  for (const std::string& name : series_names(result.runs)) {
    ChartCurve curve;
    curve.title = name;
    curve.style = series_index(result, name);
    for (const ComparedRun& run : result.runs) {
      if (run.series != name || !run.is_finished() || run.seconds.empty()) continue;
      const double error = shown_error(result, run);
      if (is_claimed(error, smallest, below) || !std::isfinite(error)) {
        curve.points.emplace_back(error, run.median_seconds());
      }
    }
    chart.curves.push_back(curve);
  }
  note_below(result, smallest, below, chart);
  const auto unfinished = std::count_if(result.runs.begin(), result.runs.end(),
                                        [](const ComparedRun& run) { return !run.is_finished(); });
  if (unfinished > 0) {
    chart.notes.push_back(fmt::format(
        "Runs that failed or were left out have no point: {}; the table names them.", unfinished));
  }
  return chart;
}

Chart exactness_chart(const ComparisonResult& result) {
  std::size_t without = 0;
  Chart chart =
      corner_chart(result, exactness_label, [&](const ComparedRun& run) -> std::optional<double> {
        if (!run.exactness.empty()) return run.exactness.front().residual.scaled;
        ++without;
        return std::nullopt;
      });
  chart.name = "exactness-error";
  chart.title = "Exactness residual against error";
  chart.reading = fmt::format(
      "The two questions in one picture, one point a run: is it right (left), and is it the map of "
      "a symplectic method (below)? The residual says how far the generating function {} is from a "
      "closed form at degree 0, relative to its largest coefficient. Neither answer implies the "
      "other: points at the lower right satisfy the generating function's equations to round-off "
      "and yet are wrong. The vertical line is the wanted error, the horizontal one {:.0e}. Colour "
      "and shape come from the symplecticity defect (next plot), which needs no inversion; the "
      "residual here is raised by the inversion's condition ({:.2g}), so that a point may lie on "
      "the other side of the horizontal line.",
      kind_text(result), largest_exact_defect, result.kind_condition);
  if (!result.kind) {
    chart.missing = no_generating_function;
  } else if (without > 0) {
    chart.notes.push_back(fmt::format(
        "Runs without a point because the generating function does not exist for their map: {}.",
        without));
  }
  return chart;
}

Chart symplecticity_chart(const ComparisonResult& result) {
  Chart chart = corner_chart(result, "symplecticity defect, all degrees, scaled",
                             [](const ComparedRun& run) -> std::optional<double> {
                               if (run.symplecticity.empty()) return std::nullopt;
                               return run.largest_symplecticity();
                             });
  chart.name = "symplecticity-error";
  chart.title = "Symplecticity defect against error";
  chart.reading = fmt::format(
      "The same runs with the quantity that decides about exactness: the largest defect of a "
      "Poisson bracket of the jet over all degrees, relative to the sum of its terms. At most "
      "{:.0e} (horizontal line) counts as exact, and at most the wanted error (vertical line) as "
      "accurate. Symplectic methods stay at round-off however coarse the step; the defect of "
      "the others falls only as their error does.",
      largest_exact_defect);
  return chart;
}

Chart cost_chart(const ComparisonResult& result) {
  Chart chart;
  chart.name = "cost-order";
  chart.title = "Cost against order";
  chart.reading =
      "Time of one configuration of each method as the degree of the jet grows. The number of "
      "coefficients grows as a binomial coefficient and a product of series as its square, "
      "roughly; "
      "lines that run parallel differ by a factor that does not depend on the order.";
  chart.x.label = "order of the jet";
  chart.x.is_integer = true;
  chart.x.margin = 0.04;
  chart.y = time_axis();
  for (const std::string& name : series_names(result.cost_runs)) {
    ChartCurve curve;
    curve.title = name;
    curve.style = series_index(result, name);
    for (const ComparedRun& run : result.cost_runs) {
      if (run.series != name || !run.is_finished() || run.seconds.empty()) continue;
      curve.points.emplace_back(run.order, run.median_seconds());
    }
    std::sort(curve.points.begin(), curve.points.end());
    chart.curves.push_back(curve);
  }
  return chart;
}

}  // namespace hamjet::io
