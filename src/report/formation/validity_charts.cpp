#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "transfer_charts.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// Most times of which validity_order_chart has a line.
constexpr std::size_t most_lines = 6;

Chart separation_chart(std::string name, std::string title) {
  Chart chart;
  chart.name = std::move(name);
  chart.title = std::move(title);
  chart.y = logarithmic_axis("largest separation", AxisUnit::metres);
  return chart;
}

/// Adds proved separations with filled markers, and predicted ones with hollow markers.
void add_curves(Chart& chart, const std::string& title, std::size_t style,
                std::vector<std::pair<double, double>> proved,
                std::vector<std::pair<double, double>> predicted) {
  ChartCurve curve;
  curve.title = title;
  curve.style = style;
  curve.points = std::move(proved);
  chart.curves.push_back(curve);
  curve.title = "";
  curve.has_line = false;
  curve.is_filled = false;
  curve.points = std::move(predicted);
  chart.curves.push_back(curve);
}

std::string meaning(const ValidityResult& result) {
  return fmt::format(
      "The line with filled markers is proved: {} of that separation flew, and "
      "the polynomial's final positions differ from theirs by no more than {}. Hollow markers are "
      "predicted from the decay of the jet's degrees alone.",
      counted(result.scene.validity->samples, "sampled deputy"),
      length_text(result.scene.validity->tolerance_m));
}

void note_limits(const ValidityResult& result, Chart& chart) {
  std::size_t count = 0;
  for (const ValidityPoint& point : result.points) {
    count += static_cast<std::size_t>(
        std::count_if(point.entries.begin(), point.entries.end(),
                      [](const ValidityEntry& entry) { return entry.is_at_limit; }));
  }
  if (count > 0) {
    chart.notes.push_back(
        fmt::format("Values that are lower bounds, because the polynomial was still right at the "
                    "largest separation tried: {}.",
                    count));
  }
}

}  // namespace

Chart validity_time_chart(const ValidityResult& result) {
  Chart chart = separation_chart("validity-time", "Validity along time");
  const TimeAxis axis = time_axis(result.scene.validity->times.back() * result.scene.units.time_s);
  chart.x.label = fmt::format("time ({})", axis.name);
  add_revolutions(result.scene, axis.seconds, chart.x);
  const double unit = result.scene.units.time_s / axis.seconds;
  for (int order = 1; order <= result.scene.order; ++order) {
    std::vector<std::pair<double, double>> proved;
    std::vector<std::pair<double, double>> predicted;
    for (const ValidityPoint& point : result.points) {
      for (const ValidityEntry& entry : point.entries) {
        if (entry.order != order) continue;
        proved.emplace_back(point.time * unit, entry.proved_m);
        predicted.emplace_back(point.time * unit, entry.predicted_m);
      }
    }
    add_curves(chart, fmt::format("order {}", order), static_cast<std::size_t>(order - 1),
               std::move(proved), std::move(predicted));
  }
  chart.reading =
      "How far from the chief a deputy may be at the start so that the polynomial of "
      "each order still says where it is after that time. " +
      meaning(result);
  note_limits(result, chart);
  return chart;
}

Chart validity_order_chart(const ValidityResult& result) {
  Chart chart = separation_chart("validity-order", "Validity against order");
  chart.x.label = "order of the polynomial";
  chart.x.is_integer = true;
  chart.x.margin = 0.04;
  std::set<std::size_t> shown;
  const std::size_t lines = std::min(result.points.size(), most_lines);
  for (std::size_t k = 1; k <= lines; ++k) shown.insert(k * result.points.size() / lines - 1);
  std::size_t style = 0;
  for (const std::size_t i : shown) {
    const ValidityPoint& point = result.points[i];
    std::vector<std::pair<double, double>> proved;
    std::vector<std::pair<double, double>> predicted;
    for (const ValidityEntry& entry : point.entries) {
      proved.emplace_back(entry.order, entry.proved_m);
      predicted.emplace_back(entry.order, entry.predicted_m);
    }
    add_curves(chart, fmt::format("{:.5g} s", point.time * result.scene.units.time_s), style++,
               std::move(proved), std::move(predicted));
  }
  chart.reading =
      "What a degree more buys at some of the times. Lines flatten towards the separation at which "
      "the series itself ceases to converge. " +
      meaning(result);
  return chart;
}

}  // namespace hamjet::io
