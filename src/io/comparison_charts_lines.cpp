#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison_charts.hpp"
#include "comparison_view.hpp"

// Plots along time, and of convergence.

namespace hamjet::io {
namespace {

std::string time_label(const Scene& scene) {
  if (!is_orbit(scene.system.model)) return "time (s)";
  return fmt::format("time (canonical; 1 is {:.4g} s)", scene.units.time_s);
}

/// A chart with a curve for each integrator along time; `measure` gives a point's value, or none.
template <class Measure>
Chart along_time_chart(const ComparisonResult& result, bool has_ticks, Measure measure) {
  Chart chart;
  chart.x.label = time_label(result.scene);
  chart.x.includes = {0, result.scene.duration};
  chart.y.is_logarithmic = true;
  chart.y.unit = AxisUnit::power;
  chart.y.smallest = 1e-18;  // far below the rounding of double
  for (std::size_t i = 0; i < result.along_time.size(); ++i) {
    const RunAlongTime& run = result.along_time[i];
    ChartCurve curve;
    curve.title = run.label;
    curve.style = i;
    curve.marker_interval = std::max(1, static_cast<int>(run.points.size() / 12));
    for (const RunAlongTime::Point& point : run.points) {
      if (const std::optional<double> value = measure(point)) {
        curve.points.emplace_back(point.time, *value);
      } else {
        curve.gaps.push_back(curve.points.size());
      }
    }
    if (has_ticks) curve.ticks = run.singular_times;
    if (!run.failure.empty()) {
      chart.notes.push_back(fmt::format("{} stopped: {}.", run.label, run.failure));
    }
    chart.curves.push_back(curve);
  }
  if (result.along_time.empty()) chart.missing = "No integrator was watched along time.";
  return chart;
}

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
  used.style = series_index(result, name);
  used.title = fit != nullptr ? fmt::format("{}: {:.2f}", name, fit->slope) : name;
  used.has_line = false;
  ChartCurve others = used;
  others.is_filled = false;
  for (const ComparedRun& run : result.runs) {
    if (run.series != name || !run.is_finished() || !run.settings.step_canonical) continue;
    if (run.error_by_degree.empty()) continue;
    const double error = run.error_by_degree.front();
    if (error < result.smallest_claimed_error(0)) {
      ++below;
      continue;
    }
    const bool is_used = fit != nullptr && std::find(fit->labels.begin(), fit->labels.end(),
                                                     run.settings.label) != fit->labels.end();
    // The duration is cut into equal steps not longer than the one asked for.
    const double step = std::abs(result.scene.duration) / static_cast<double>(run.statistics.steps);
    (is_used ? used : others).points.emplace_back(step, error);
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

Chart exactness_along_time_chart(const ComparisonResult& result) {
  Chart chart = along_time_chart(result, true,
                                 [](const RunAlongTime::Point& point) { return point.exactness; });
  chart.name = "exactness-time";
  chart.title = "Exactness residual along time";
  chart.y.label = "exactness residual, degree 0, scaled";
  chart.reading = fmt::format(
      "The figure of Guibout and Bloch: how far the generating function {} of each of the scene's "
      "integrators is from closed at degree 0, as the flow goes on. A symplectic method stays at "
      "round-off, amplified where the kind comes near to a time at which it does not exist; a "
      "method that is not symplectic drifts upwards. A short stroke at the lower edge in the "
      "line's "
      "colour marks each time at which the kind does not exist, where the determinant of its "
      "linear part changes sign; a line is broken where the residual could not be computed. A low "
      "line says that a map is exact, not that it is right.",
      kind_text(result));
  if (!result.kind) {
    chart.missing =
        "The jet is not expanded in all variables of phase space: there is no generating function.";
  }
  return chart;
}

Chart energy_along_time_chart(const ComparisonResult& result) {
  Chart chart = along_time_chart(result, false, [](const RunAlongTime::Point& point) {
    return std::optional<double>(std::abs(point.energy_error));
  });
  chart.name = "energy-time";
  chart.title = "Energy error along time";
  chart.y.label = "|energy error|, relative";
  chart.reading =
      "Magnitude of the relative energy error along the nominal. The error of a symplectic method "
      "with fixed steps goes up and down with the orbit and does not grow; that of the others "
      "usually "
      "grows in proportion to time. Round-off alone is a random walk near 1e-16.";
  return chart;
}

Chart convergence_chart(const ComparisonResult& result) {
  Chart chart;
  chart.name = "convergence";
  chart.title = "Orders of convergence";
  chart.reading =
      "Relative error of degree 0 (the nominal) against the step, for the series with fixed steps. "
      "The number beside a name is the fitted order, the slope of the line through the filled "
      "markers. Hollow markers were not used: their error is above 1e-2, where the leading term "
      "does "
      "not govern, or within a factor of 100 of the smallest of all runs, the rounding floor, or "
      "there are four finer ones. A series with fewer than three usable runs, or whose runs "
      "scatter "
      "about the line by more than a tenth of a decade, has no fit.";
  chart.x.label = "step (canonical time)";
  chart.x.is_logarithmic = true;
  chart.x.unit = AxisUnit::power;
  chart.y.label = "relative error of degree 0";
  chart.y.is_logarithmic = true;
  chart.y.unit = AxisUnit::power;
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
  if (chart.curves.empty()) chart.missing = "No series of the comparison has fixed steps.";
  return chart;
}

}  // namespace hamjet::io
