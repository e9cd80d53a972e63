#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "../../formats/relative_frame_text.hpp"
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

}  // namespace

std::vector<Chart> relative_trajectory_charts(const RelativeTrajectory& trajectory) {
  double largest_m = 0;
  for (const RelativeState& state : trajectory.states) {
    largest_m = std::max(largest_m, state.position_m.cwiseAbs().maxCoeff());
  }
  const bool is_in_km = largest_m >= 1000;
  const double unit = is_in_km ? 1e-3 : 1;
  const auto letters = axis_letters(trajectory.frame);
  const auto columns = axis_columns(trajectory.frame);
  std::vector<Chart> charts;
  for (const Projection& projection : projections) {
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
    chart.x.margin = chart.y.margin = 0.05;
    const auto place = [&](const RelativeState& state) {
      return std::pair(state.position_m[projection.across] * unit,
                       state.position_m[projection.upwards] * unit);
    };
    ChartCurve path;
    path.title = "deputy";
    path.has_markers = false;
    for (const RelativeState& state : trajectory.states) path.points.push_back(place(state));
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
    mark("chief", 2, {0, 0});
    charts.push_back(std::move(chart));
  }
  const bool is_inertial = trajectory.frame == RelativeFrame::inertial;
  charts.front().reading = fmt::format(
      "The deputy as it was flown, relative to the chief at the origin, in three projections of "
      "equal scale along both axes. {}",
      is_inertial ? "The axes x, y, z are the inertial ones of the orbit."
                  : "R points away from the centre of the Earth, N along the orbit's angular "
                    "momentum, T completes them and points along the motion; the axes turn with "
                    "the chief.");
  return charts;
}

}  // namespace hamjet::io
