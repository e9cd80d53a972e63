#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison_charts.hpp"
#include "comparison_view.hpp"

// The plot of convergence.

namespace hamjet::io {
namespace {

const ConvergenceFit* fit_of(const ComparisonResult& result, const std::string& series) {
  for (const ConvergenceFit& fit : result.fits) {
    if (fit.series == series && fit.degree == 0) return &fit;
  }
  return nullptr;
}

/// The fitted line over the steps of the points that were used, through their mean.
ChartCurve fitted_line(const ChartCurve& used, double slope) {
  ChartCurve line = used;
  line.title.clear();
  line.has_line = true;
  line.has_markers = false;
  line.points.clear();
  double x = 0;
  double y = 0;
  for (const auto& [step, error] : used.points) {
    x += std::log(step) / static_cast<double>(used.points.size());
    y += std::log(error) / static_cast<double>(used.points.size());
  }
  const auto [least, most] = std::minmax_element(used.points.begin(), used.points.end());
  for (const double step : {least->first, most->first}) {
    line.points.emplace_back(step, std::exp(y + slope * (std::log(step) - x)));
  }
  return line;
}

/// The runs of one fixed-step series: those that the fit used, and the others.
void add_convergence(const ComparisonResult& result, const std::string& name, std::size_t& below,
                     Chart& chart) {
  const ConvergenceFit* fit = fit_of(result, name);
  ChartCurve used;
  const SeriesLook look = series_look(result, name);
  used.style = look.shape;
  used.colour = look.colour;
  used.title = fit != nullptr ? fmt::format("{}: {:.2f}", name, fit->slope) : name;
  used.has_line = false;
  ChartCurve others = used;
  others.is_filled = false;
  if (fit != nullptr) used.points = fit->points;
  for (const ComparedRun& run : result.runs) {
    if (run.series != name || !run.is_finished() || !run.settings.step_canonical) continue;
    if (run.error_by_degree.empty()) continue;
    const double error = run.error_by_degree.front();
    if (error < result.smallest_claimed_error(0)) {
      ++below;
      continue;
    }
    if (fit != nullptr && std::find(fit->labels.begin(), fit->labels.end(), run.settings.label) !=
                              fit->labels.end()) {
      continue;
    }
    // The duration is cut into equal steps not longer than the one asked for.
    const double step = std::abs(result.scene.duration) / static_cast<double>(run.statistics.steps);
    others.points.emplace_back(step, error);
  }
  if (used.points.empty() && others.points.empty()) return;
  if (!used.points.empty()) {
    others.title.clear();
    if (used.points.size() > 1) chart.curves.push_back(fitted_line(used, fit->slope));
    chart.curves.push_back(used);
  }
  chart.curves.push_back(others);
}

}  // namespace

Chart convergence_chart(const ComparisonResult& result) {
  Chart chart;
  chart.name = "convergence";
  chart.title = "Orders of convergence";
  chart.reading =
      "Relative error of degree 0 (the nominal) against the step, for the series with fixed steps. "
      "The number beside a name is the fitted order, the slope of the line through the filled "
      "markers. Hollow markers were not used: their error is above 1e-2, where the leading term "
      "does "
      "not govern, or within a factor of 100 of the rounding floor (the smallest error of "
      "all runs, or of the series where its error rises again), or "
      "there are four finer ones. Where that leaves no slope within 0.3 of theory, four runs in "
      "extended precision, below the floor of double precision, take the fit over, with the next "
      "term of the error's expansion fitted beside the slope; over the first eighth or "
      "sixty-fourth of the duration (the table says which) where the whole would take too long or "
      "its leading term does not dominate. A series with too few usable runs, "
      "or whose runs scatter about the fit by more than a tenth of a decade, has none.";
  chart.x = logarithmic_axis("step", AxisUnit::seconds);
  chart.y = logarithmic_axis("relative error of degree 0");
  chart.x.margin = chart.y.margin = 0.05;
  std::size_t below = 0;
  for (const std::string& name : series_names(result.runs)) {
    add_convergence(result, name, below, chart);
  }
  if (below > 0) {
    chart.notes.push_back(fmt::format(
        "Not drawn: runs with an error below {:.1e}, ten times the reference's uncertainty: {}.",
        result.smallest_claimed_error(0), below));
  }
  for (ChartCurve& curve : chart.curves) {
    for (auto& point : curve.points) point.first *= result.scene.units.time_s;
  }
  if (chart.curves.empty()) chart.missing = "No series of the comparison has fixed steps.";
  return chart;
}

}  // namespace hamjet::io
