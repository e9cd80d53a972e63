#include "energy_conservation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "../../text/time_axis.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// Curves as wide as a figure can show: of every run of neighbours the one with the largest value.
Points envelope(const Points& points) {
  constexpr std::size_t most_drawn_points = 1000;
  const std::size_t width = points.size() / most_drawn_points + 1;
  Points result;
  for (std::size_t i = 0; i < points.size(); i += width) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        points.begin() + static_cast<std::ptrdiff_t>(std::min(i + width, points.size()));
    result.push_back(*std::max_element(
        begin, end, [](const auto& a, const auto& b) { return a.second < b.second; }));
  }
  return result;
}

ChartCurve line(std::string title, std::size_t style, const Points& points) {
  ChartCurve curve;
  curve.title = std::move(title);
  curve.style = style;
  curve.points = envelope(points);
  curve.has_markers = curve.points.size() == 1;
  return curve;
}

TimeAxis axis_of(const EnergyConservationResult& result) {
  double longest = 0;
  for (const EnergyConservationPoint& point : result.points) {
    longest = std::max(longest, std::abs(point.time));
  }
  for (const auto& [time, error] : result.fixed_step.energy_errors) {
    longest = std::max(longest, std::abs(time));
  }
  return time_axis(longest * result.study.units.time_s);
}

/// A canonical unit of time on the axis of time.
double time_unit(const EnergyConservationResult& result) {
  return result.study.units.time_s / axis_of(result).seconds;
}

Chart along_time(const EnergyConservationResult& result, std::string label) {
  Chart chart;
  chart.x.label = fmt::format("time ({})", axis_of(result).name);
  chart.x.includes = {0};
  chart.y = logarithmic_axis(std::move(label));
  if (result.predicted_time) {
    chart.rules.push_back({true, *result.predicted_time * time_unit(result), "predicted to stop"});
  }
  return chart;
}

/// What the vertical line of the charts means.
std::string rule_text(const EnergyConservationResult& result) {
  if (!result.predicted_time) return "";
  return fmt::format(
      " The vertical line is where the method is predicted to stop in the limit of small steps: "
      "{} changes sign there.",
      result.study.method == EnergyConservingMethod::stormer ? "dV/dt" : "G = f.H''f");
}

Chart error_chart(const EnergyConservationResult& result) {
  Chart chart = along_time(result, "|energy error| / |H(z_0)|");
  chart.name = "energy-errors";
  chart.title = "Energy errors along time";
  chart.reading =
      "The discrete energy, which the method conserves, stays at round-off; H at the points of the "
      "trajectory goes up and down with the square of the step size (for Störmer with the step "
      "size), as it does for the method with fixed steps." +
      rule_text(result);
  chart.y.floor = rounding_of(Precision::double_precision);
  chart.y.floor_name = "the rounding of double precision";
  const double unit = time_unit(result);
  Points discrete;
  Points energy;
  for (const EnergyConservationPoint& point : result.points) {
    // The error of the first step, which sets the energy, is 0 by definition.
    if (point.discrete && point.step > 0 && *point.discrete != 0) {
      discrete.emplace_back(point.time * unit, std::abs(*point.discrete));
    }
    if (point.step > 0) energy.emplace_back(point.time * unit, std::abs(point.energy_error));
  }
  Points fixed;
  for (const auto& [time, error] : result.fixed_step.energy_errors) {
    if (time != 0) fixed.emplace_back(time * unit, std::abs(error));
  }
  chart.curves.push_back(line("discrete energy, conserved", 0, discrete));
  chart.curves.push_back(line("H(z_k), energy-conserving", 1, energy));
  chart.curves.push_back(line("H, " + result.fixed_step.method + ", fixed steps", 2, fixed));
  return chart;
}

Chart step_chart(const EnergyConservationResult& result) {
  Chart chart = along_time(result, "step size (s)");
  chart.name = "step-size";
  chart.title = "Step size along time";
  chart.reading = fmt::format(
      "The step size that the energy equation asks for. To leading order it varies as {}.{}",
      result.study.method == EnergyConservingMethod::stormer ? "|dV/dt|^(-1/2)" : "|G|^(-1/3)",
      rule_text(result));
  const double unit = time_unit(result);
  const double seconds = result.study.units.time_s;
  Points sizes;
  for (const EnergyConservationPoint& point : result.points) {
    if (point.size) sizes.emplace_back(point.time * unit, std::abs(*point.size) * seconds);
  }
  // Steps of one magnitude say more on a straight axis than within a decade.
  const auto [least, most] = std::minmax_element(
      sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (!sizes.empty() && most->second < 20 * least->second) {
    chart.y.is_logarithmic = false;
    chart.y.includes = {0};
    chart.y.margin = 0.04;
  }
  chart.curves.push_back(line("energy-conserving", 0, sizes));
  const auto& errors = result.fixed_step.energy_errors;
  const double fixed = result.fixed_step.step * seconds;
  chart.curves.push_back(
      line("fixed steps beside", 2, {{0, fixed}, {errors.back().first * unit, fixed}}));
  return chart;
}

}  // namespace

std::vector<Chart> energy_conservation_charts(const EnergyConservationResult& result) {
  return {error_chart(result), step_chart(result)};
}

}  // namespace hamjet::io
