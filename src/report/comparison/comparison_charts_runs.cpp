#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../drawing/along_time_charts.hpp"
#include "comparison_charts.hpp"
#include "comparison_view.hpp"
#include "run_chart_parts.hpp"

// Plots with one point a run; that of work and precision has a file of its own.

namespace hamjet::io {
namespace {

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
  chart.rules.push_back(
      {false, largest_exact_defect, fmt::format("exact: at most {:.0e}", largest_exact_defect)});
  add_wanted_error(result, chart);
  const auto name = [](Corner corner) { return std::string(corner_text(corner)); };
  chart.corners = {{false, false, name(Corner::exact_and_accurate)},
                   {true, false, name(Corner::exact_but_wrong)},
                   {false, true, name(Corner::accurate_not_symplectic)},
                   {true, true, name(Corner::neither)}};
  return chart;
}

}  // namespace

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
      "and yet are wrong. Colour "
      "and shape come from the symplecticity defect (next plot), which needs no inversion; the "
      "residual here is raised by the inversion's condition ({:.2g}), so that a point may lie on "
      "the other side of the horizontal line.",
      kind_text(result), result.kind_condition);
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
  chart.y = run_time_axis();
  for (const std::string& name : series_names(result.cost_runs)) {
    ChartCurve curve;
    curve.title = name;
    const SeriesLook look = series_look(result, name);
    curve.style = look.shape;
    curve.colour = look.colour;
    curve.is_filled = look.is_filled;
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
