#include "along_time_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../studies/nominal/nominal_period.hpp"
#include "../../text/time_axis.hpp"

namespace hamjet::io {
namespace {

/// Vertical lines at the times of one run that no run before had; those of the flow are the same
/// for all that go so far.
void add_singular_times(const std::vector<double>& times, double unit, Chart& chart) {
  const double nearest = 1e-3 * std::abs(chart.x.includes.back());
  for (const double time : times) {
    const bool is_new = std::none_of(
        chart.rules.begin(), chart.rules.end(),
        [&](const ChartRule& rule) { return std::abs(rule.place - time * unit) < nearest; });
    if (is_new) chart.rules.push_back({true, time * unit, "kind does not exist", true});
  }
}

/// A chart with a curve for each integrator along time; `measure` gives a point's value, or none.
template <class Measure>
Chart along_time_chart(const Scene& scene, const std::vector<RunAlongTime>& runs, std::string label,
                       bool is_of_kind, Measure measure) {
  Chart chart;
  const TimeAxis axis = time_axis(scene.duration * scene.units.time_s);
  const double unit = scene.units.time_s / axis.seconds;
  chart.x.label = fmt::format("time ({})", axis.name);
  chart.x.includes = {0, scene.duration * unit};
  add_revolutions(scene, axis.seconds, chart.x);
  chart.y = logarithmic_axis(std::move(label));
  chart.y.floor = rounding_of(scene.precision);
  chart.y.floor_name = scene.precision == Precision::double_precision
                           ? "the rounding of double precision"
                           : "the rounding of extended precision";
  std::size_t without = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunAlongTime& run = runs[i];
    ChartCurve curve;
    curve.title = run.label;
    curve.style = i;
    // Every computed point has its marker, as long as markers can be told apart.
    constexpr std::size_t most_markers = 60;
    if (run.points.size() > most_markers) {
      curve.marker_interval = static_cast<int>(run.points.size() / 12);
    }
    auto singular = run.singular_times.begin();
    for (const RunAlongTime::Point& point : run.points) {
      // Where the kind does not exist in between, a line from point to point would be no curve.
      const auto next = std::find_if(singular, run.singular_times.end(), [&](double time) {
        return std::abs(time) > std::abs(point.time);
      });
      if (is_of_kind && next != singular) curve.gaps.push_back(curve.points.size());
      singular = next;
      if (const std::optional<double> value = measure(point)) {
        curve.points.emplace_back(point.time * unit, *value);
      } else {
        curve.gaps.push_back(curve.points.size());
        ++without;
      }
    }
    if (is_of_kind) add_singular_times(run.singular_times, unit, chart);
    if (!run.failure.empty()) {
      chart.notes.push_back(fmt::format("{} stopped: {}.", run.label, run.failure));
    }
    if (is_of_kind && !run.not_searched.empty()) {
      chart.notes.push_back(
          fmt::format("{}: the times at which the kind does not exist were not looked for: {}.",
                      run.label, run.not_searched));
    }
    chart.curves.push_back(curve);
  }
  if (!chart.rules.empty()) {
    chart.notes.emplace_back(
        "Lines are broken at the vertical lines, where the kind does not exist.");
  }
  if (without > 0) {
    chart.notes.push_back(fmt::format(
        "Lines are broken at points where the residual could not be computed: {}.", without));
  }
  if (runs.empty()) chart.missing = "No integrator was watched along time.";
  return chart;
}

}  // namespace

void add_revolutions(const Scene& scene, double seconds, ChartAxis& x) {
  const std::optional<double> period = nominal_period(scene);
  if (!period || !is_orbit(scene.system.model)) return;
  x.top_unit = *period * scene.units.time_s / seconds;
  x.top_label = "revolutions";
}

std::string kind_text(const GeneratingFunctionKind& kind) {
  for (const char* name : {"F1", "F2", "F3", "F4"}) {
    if (parse_kind(name, kind.degrees_of_freedom()) == kind) {
      return fmt::format("{} ({})", name, kind.name());
    }
  }
  return kind.name();
}

Chart exactness_along_time_chart(const Scene& scene,
                                 const std::optional<GeneratingFunctionKind>& kind,
                                 const std::vector<RunAlongTime>& runs) {
  Chart chart = along_time_chart(scene, runs, exactness_label, true,
                                 [](const RunAlongTime::Point& point) { return point.exactness; });
  chart.name = "exactness-time";
  chart.title = "Exactness residual along time";
  chart.reading = fmt::format(
      "The figure of Guibout and Bloch: how far the generating function {} of each of the scene's "
      "integrators is from closed at degree 0, as the flow goes on. A symplectic method stays at "
      "round-off, amplified where the kind comes near to a time at which it does not exist; a "
      "method that is not symplectic drifts upwards. A vertical line marks each time at which the "
      "kind does not exist: those of the exact flow, found as hamjet transfer finds them. Points "
      "are the ends of the integrator's steps. A "
      "low line says "
      "that a map is exact, not that it is right.",
      kind ? kind_text(*kind) : "");
  if (!kind) {
    chart.missing = no_generating_function;
  }
  return chart;
}

Chart energy_along_time_chart(const Scene& scene, const std::vector<RunAlongTime>& runs) {
  Chart chart = along_time_chart(scene, runs, "|energy error|, relative", false,
                                 [](const RunAlongTime::Point& point) {
                                   return std::optional<double>(std::abs(point.energy_error));
                                 });
  chart.name = "energy-time";
  chart.title = "Energy error along time";
  chart.reading =
      "Magnitude of the relative energy error along the nominal. The error of a symplectic method "
      "with fixed steps goes up and down with the orbit and does not grow; that of the others "
      "usually "
      "grows in proportion to time. Round-off alone is a random walk near 1e-16.";
  return chart;
}

}  // namespace hamjet::io
