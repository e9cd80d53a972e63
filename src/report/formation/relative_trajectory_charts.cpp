#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "../../formats/relative_frame_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"
#include "relative_extent.hpp"
#include "transfer_charts.hpp"

namespace hamjet::io {
namespace {

/// A plane: the axis that runs across and the one that runs upwards.
struct Projection {
  Eigen::Index across;
  Eigen::Index upwards;
};

/// The planes drawn, in RTN: T-R as seen from above the orbit's plane, the motion to the right; T-N
/// and R-N.
constexpr std::array<Projection, 3> projections = {{{1, 0}, {1, 2}, {0, 2}}};

/// The places that are drawn: the path, and the chief unless the path would be a dot beside it.
RelativeExtent extent_of(const RelativeTrajectory& trajectory) {
  RelativeExtent extent;
  extent.include(trajectory.states);
  const Eigen::Vector3d chief = Eigen::Vector3d::Zero();
  if (trajectory.states.empty() || extent.is_near(chief, most_spans_to_chief))
    extent.include(chief);
  return extent;
}

/// What equal scales hide of a component that is small beside the others: "R from -2.03 km to 214 m
/// (amplitude 1.12 km)".
std::string amplitude_text(const RelativeTrajectory& trajectory, Eigen::Index axis,
                           std::string_view letter) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const RelativeState& state : trajectory.states) {
    least = std::min(least, state.position_m[axis]);
    most = std::max(most, state.position_m[axis]);
  }
  return fmt::format("{} from {} to {} (amplitude {})", letter, length_text(least),
                     length_text(most), length_text((most - least) / 2));
}

/// The only coordinate of a system against the time.
Chart chart_of_one(const RelativeTrajectory& trajectory, double time_s, const std::string& axis) {
  const RelativeExtent extent = extent_of(trajectory);
  const bool is_in_km = extent.largest_m() >= 1000;
  const TimeAxis time = time_axis(trajectory.times.empty() ? 0 : trajectory.times.back() * time_s);
  Chart chart;
  chart.name = "relative-" + axis;
  chart.title = fmt::format("Relative trajectory, {} against the time", axis);
  chart.x.label = fmt::format("time ({})", time.name);
  chart.y.label = fmt::format("{} ({})", axis, is_in_km ? "km" : "m");
  chart.is_panel = true;
  ChartCurve path;
  path.title = "deputy";
  path.has_markers = false;
  for (std::size_t i = 0; i < trajectory.states.size(); ++i) {
    path.points.emplace_back(trajectory.times[i] * time_s / time.seconds,
                             trajectory.states[i].position_m[0] * (is_in_km ? 1e-3 : 1));
  }
  chart.curves.push_back(std::move(path));
  chart.notes.push_back(fmt::format("Of the deputy: {}.", amplitude_text(trajectory, 0, axis)));
  chart.reading = "The deputy as it was flown, less the chief.";
  return chart;
}

}  // namespace

std::vector<Chart> relative_trajectory_charts(const RelativeTrajectory& trajectory, double time_s,
                                              std::vector<std::string> axes) {
  if (axes.size() == 1) return {chart_of_one(trajectory, time_s, axes[0])};
  const RelativeExtent extent = extent_of(trajectory);
  const bool has_chief = extent.is_near(Eigen::Vector3d::Zero(), 1);
  const bool is_in_km = extent.largest_m() >= 1000;
  const double unit = is_in_km ? 1e-3 : 1;
  const auto usual = axis_letters(trajectory.frame);
  const auto in_names = axis_columns(trajectory.frame);
  std::vector<std::string> columns = axes;
  if (axes.empty()) {
    axes.assign(usual.begin(), usual.end());
    columns.assign(in_names.begin(), in_names.end());
  }
  const std::vector<std::string>& letters = axes;
  const TimeAxis time = time_axis(trajectory.times.empty() ? 0 : trajectory.times.back() * time_s);
  std::vector<double> times;
  for (const double t : trajectory.times) times.push_back(t * time_s / time.seconds);
  std::vector<Chart> charts;
  for (const Projection& projection : projections) {
    const auto count = static_cast<Eigen::Index>(letters.size());
    if (projection.across >= count || projection.upwards >= count) continue;
    const auto letter = [&](Eigen::Index axis) { return letters[static_cast<std::size_t>(axis)]; };
    const auto column = [&](Eigen::Index axis) { return columns[static_cast<std::size_t>(axis)]; };
    Chart chart;
    chart.name =
        fmt::format("relative-{}{}", column(projection.across), column(projection.upwards));
    chart.title = fmt::format("Relative trajectory, {} against {}", letter(projection.upwards),
                              letter(projection.across));
    chart.is_isometric = true;
    chart.x.label = fmt::format("{} ({})", letter(projection.across), is_in_km ? "km" : "m");
    chart.y.label = fmt::format("{} ({})", letter(projection.upwards), is_in_km ? "km" : "m");
    chart.is_panel = true;
    chart.value_label = fmt::format("time ({})", time.name);
    chart.x.margin = chart.y.margin = 0.05;
    for (const auto& [drawn, component] :
         {std::pair(&chart.x, projection.across), std::pair(&chart.y, projection.upwards)}) {
      const double middle = (extent.least[component] + extent.most[component]) / 2;
      drawn->includes = {(middle - extent.span_m() / 2) * unit,
                         (middle + extent.span_m() / 2) * unit};
    }
    const auto place = [&](const RelativeState& state) {
      return std::pair(state.position_m[projection.across] * unit,
                       state.position_m[projection.upwards] * unit);
    };
    ChartCurve path;
    path.title = "deputy";
    path.has_markers = false;
    for (const RelativeState& state : trajectory.states) path.points.push_back(place(state));
    path.values = times;
    chart.curves.push_back(path);
    const auto mark = [&](std::string title, std::size_t style, std::pair<double, double> point) {
      ChartCurve curve;
      curve.title = std::move(title);
      curve.style = style;
      curve.has_line = false;
      curve.points.push_back(point);
      chart.curves.push_back(curve);
    };
    if (!trajectory.states.empty()) {
      mark("start", 3, place(trajectory.states.front()));
      mark("end", 1, place(trajectory.states.back()));
    }
    if (has_chief) mark("chief", 2, {0, 0});
    charts.push_back(std::move(chart));
  }
  const std::string_view meaning =
      trajectory.frame == RelativeFrame::coordinates ? "The axes are the system's coordinates."
      : trajectory.frame == RelativeFrame::inertial
          ? "The axes x, y, z are the inertial ones of the orbit."
          : "R points away from the centre of the Earth, N along the orbit's angular momentum, T "
            "completes them and points along the motion; the axes turn with the chief.";
  if (!has_chief) {
    charts.front().notes.push_back(
        fmt::format("So that the path can be seen {}.", far_chief_text(extent)));
  }
  std::vector<std::string> amplitudes;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    amplitudes.push_back(amplitude_text(trajectory, static_cast<Eigen::Index>(i), letters[i]));
  }
  charts.front().notes.push_back(fmt::format("Of the deputy: {}.", fmt::join(amplitudes, "; ")));
  charts.front().reading = fmt::format(
      "The deputy as it was flown, relative to the chief at the origin, {} of "
      "one scale for all axes; its colour is the time. {}",
      charts.size() == 1 ? "in a plane" : "in three projections", meaning);
  return charts;
}

}  // namespace hamjet::io
