#include "chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../../text/quantity_text.hpp"

namespace hamjet::io {
namespace {

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool is_empty() const { return least > most; }
  double width() const { return most - least; }
  void widen(double wanted) {
    const double middle = (least + most) / 2;
    least = middle - wanted / 2;
    most = middle + wanted / 2;
  }
};

bool can_be_drawn(const ChartAxis& axis, double value) {
  return std::isfinite(value) && (!axis.is_logarithmic || value > 0);
}

void set_limits(ChartAxis& axis, Range range, bool needs_room_below) {
  if (!axis.is_logarithmic) {
    // A single value still needs an axis.
    const double size = std::max(std::abs(range.least), std::abs(range.most));
    if (range.width() <= 1e-12 * size || size == 0) range.widen(size > 0 ? size : 1);
    const double width = range.width();
    axis.lower = range.least - axis.margin * width;
    axis.upper = range.most + axis.margin * width;
    return;
  }
  double lower = std::floor(std::log10(range.least) - axis.margin + 1e-9);
  double upper = std::ceil(std::log10(range.most) + axis.margin - 1e-9);
  if (upper <= lower) upper = lower + 1;
  if (needs_room_below) lower -= std::max(1.0, std::round((upper - lower) / 12));
  axis.lower = std::pow(10, std::max(lower, -300.0));
  axis.upper = std::pow(10, std::min(upper, 300.0));
}

/// Lifts what is below the floor of y to it; returns how many there were.
std::size_t lift(const ChartAxis& y, ChartCurve& curve) {
  std::size_t lifted = 0;
  for (auto& point : curve.points) {
    if (!(point.second >= 0 && point.second < y.floor)) continue;
    point.second = y.floor;
    ++lifted;
  }
  return lifted;
}

/// Splits a curve into what can be drawn and the zeros; returns the number of the others.
std::size_t split(const Chart& chart, ChartCurve& curve, ChartCurve& zeros) {
  std::vector<std::pair<double, double>> kept;
  std::vector<double> values;
  std::vector<std::size_t> gaps;
  std::size_t omitted = 0;
  bool is_broken = false;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    is_broken |= std::find(curve.gaps.begin(), curve.gaps.end(), i) != curve.gaps.end();
    const auto& point = curve.points[i];
    if (can_be_drawn(chart.x, point.first) && can_be_drawn(chart.y, point.second)) {
      if (is_broken) gaps.push_back(kept.size());
      is_broken = false;
      kept.push_back(point);
      if (!curve.values.empty()) values.push_back(curve.values[i]);
      continue;
    }
    is_broken = true;
    if (can_be_drawn(chart.x, point.first) && point.second == 0) {
      zeros.points.push_back(point);
    } else {
      ++omitted;
    }
  }
  curve.points = std::move(kept);
  curve.values = std::move(values);
  curve.gaps = std::move(gaps);
  return omitted;
}

void fit_axes(Chart& chart) {
  Range x;
  Range y;
  std::size_t omitted = 0;
  std::size_t lifted = 0;
  bool has_ticks = false;
  for (ChartCurve& curve : chart.curves) {
    lifted += lift(chart.y, curve);
    ChartCurve zeros = curve;
    zeros.points.clear();
    zeros.ticks.clear();
    omitted += split(chart, curve, zeros);
    for (const auto& point : curve.points) {
      x.include(point.first);
      y.include(point.second);
    }
    for (const auto& point : zeros.points) x.include(point.first);
    for (const double tick : curve.ticks) x.include(tick);
    has_ticks |= !curve.ticks.empty();
    if (!zeros.points.empty()) chart.at_limit.push_back(std::move(zeros));
  }
  if (omitted > 0) {
    chart.notes.push_back(
        fmt::format("Values that are not drawn because they are not finite, or zero on a "
                    "logarithmic horizontal axis: {}.",
                    omitted));
  }
  if (lifted > 0) {
    const std::string floor = chart.y.unit == AxisUnit::metres
                                  ? length_text(chart.y.floor)
                                  : fmt::format("{:.1e}", chart.y.floor);
    chart.rules.push_back({false, chart.y.floor, "floor: " + floor});
    chart.notes.push_back(
        fmt::format("Values below the floor of {}, {}, say nothing and are drawn at it: {}.", floor,
                    chart.y.floor_name, lifted));
  }
  if (!chart.at_limit.empty()) {
    chart.notes.emplace_back(
        "A triangle that points down at the lower edge is a value of zero, which a logarithmic "
        "axis has no place for.");
  }
  if (x.is_empty() && !chart.map) return;
  // If all values are zero, or none exists, the marks still need some decades to be drawn in.
  if (y.is_empty() && !chart.map) y = {1e-16, 1};
  if (chart.map) {
    for (const ChartCell& cell : chart.map->cells) {
      for (const double place : {cell.left, cell.right}) x.include(place);
      for (const double place : {cell.lower, cell.upper}) y.include(place);
    }
  }
  for (const double place : chart.x.includes) x.include(place);
  for (const double place : chart.y.includes) y.include(place);
  for (const ChartRule& rule : chart.rules) (rule.is_vertical ? x : y).include(rule.place);
  if (chart.is_isometric) {
    // Neither side of a straight line may vanish.
    constexpr double least_ratio = 0.2;
    const double wanted = least_ratio * std::max(x.width(), y.width());
    for (Range* range : {&x, &y}) {
      if (range->width() < wanted) range->widen(wanted);
    }
  }
  set_limits(chart.x, x, false);
  set_limits(chart.y, y, !chart.at_limit.empty() || has_ticks);
  for (ChartBand& band : chart.bands) {
    if (band.to < band.from) std::swap(band.from, band.to);
    band.from = std::max(band.from, chart.x.lower);
    band.to = std::min(band.to, chart.x.upper);
  }
  std::erase_if(chart.bands, [](const ChartBand& band) { return !(band.from < band.to); });
  for (ChartCurve& zeros : chart.at_limit) {
    for (auto& point : zeros.points) point.second = chart.y.lower;
  }
}

}  // namespace

ChartAxis logarithmic_axis(std::string label, AxisUnit unit) {
  ChartAxis axis;
  axis.label = std::move(label);
  axis.unit = unit;
  axis.is_logarithmic = true;
  return axis;
}

void fit(Chart& chart) {
  const auto is_empty = [](const ChartCurve& c) { return c.points.empty() && c.ticks.empty(); };
  std::erase_if(chart.curves, is_empty);
  fit_axes(chart);
  std::erase_if(chart.curves, is_empty);
  const bool is_without = chart.curves.empty() && chart.at_limit.empty() && !chart.map;
  if (is_without && chart.missing.empty()) {
    chart.missing = "No run has values for this plot.";
  }
  // An empty plot says why, and has no marks left to explain.
  if (!chart.missing.empty()) chart.curves.clear();
}

}  // namespace hamjet::io
