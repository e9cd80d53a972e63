#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "../../formats/relative_frame_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"
#include "../drawing/along_time_charts.hpp"
#include "deputy_motion_report.hpp"

namespace hamjet::io {
namespace {

/// A chart over the time of the motion, with revolutions at the top.
Chart chart_of(const DeputyMotion& motion, const TimeAxis& axis) {
  Chart chart;
  chart.x.label = fmt::format("time ({})", axis.name);
  add_revolutions(motion.scene, axis.seconds, chart.x);
  return chart;
}

}  // namespace

Chart deputy_motion_chart(const DeputyMotion& motion) {
  const TimeAxis axis = time_axis(seconds_at(motion, motion.points.size() - 1));
  Chart chart = chart_of(motion, axis);
  chart.name = "motion-time";
  chart.title = "The deputy relative to its chief along time";
  double largest = 0;
  for (const DeputyMotionPoint& point : motion.points) {
    largest = std::max(largest, point.state.position_m.norm());
  }
  const bool is_far = largest >= 1000;
  chart.y.label = is_far ? "relative position (km)" : "relative position (m)";
  const double unit_m = is_far ? 1000 : 1;
  const auto letters = axis_letters(motion.scene.deputy->frame);
  const auto curve_of = [&](std::string title, std::size_t style, const auto& value_m) {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_markers = false;
    for (std::size_t i = 0; i < motion.points.size(); ++i) {
      curve.points.emplace_back(seconds_at(motion, i) / axis.seconds,
                                value_m(motion.points[i].state.position_m) / unit_m);
    }
    chart.curves.push_back(std::move(curve));
  };
  for (std::size_t i = 0; i < letters.size(); ++i) {
    curve_of(std::string(letters[i]), i,
             [i](const Eigen::Vector3d& place) { return place[static_cast<Eigen::Index>(i)]; });
  }
  curve_of("separation", letters.size(), [](const Eigen::Vector3d& place) { return place.norm(); });
  chart.reading = fmt::format(
      "Where the deputy is relative to its chief along {}, and how far from it, as both flew.",
      frame_text(motion.scene.deputy->frame));
  return chart;
}

Chart deputy_motion_error_chart(const DeputyMotion& motion) {
  const TimeAxis axis = time_axis(seconds_at(motion, motion.points.size() - 1));
  Chart chart = chart_of(motion, axis);
  chart.name = "motion-error";
  chart.title = "Errors of the polynomials along time";
  chart.y = logarithmic_axis("position error", AxisUnit::metres);
  chart.y.floor = motion.flight_floor_m;
  chart.y.floor_name = "the rounding of the flights";
  chart.reading = fmt::format(
      "The distance between where the polynomial of each order has the deputy and where it flew "
      "to, both relative to the chief. Flights are right to {}; an error below that says nothing.",
      length_text(motion.flight_floor_m));
  for (int order = 1; order <= motion.scene.order; ++order) {
    ChartCurve curve;
    curve.title = fmt::format("order {}", order);
    curve.style = static_cast<std::size_t>(order - 1);
    curve.has_markers = false;
    for (std::size_t i = 1; i < motion.points.size(); ++i) {
      curve.points.emplace_back(seconds_at(motion, i) / axis.seconds,
                                motion.points[i].errors_m[static_cast<std::size_t>(order - 1)]);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace hamjet::io
