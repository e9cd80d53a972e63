#include <fmt/format.h>

#include <algorithm>

#include "../../formats/relative_frame_text.hpp"
#include "relative_extent.hpp"
#include "transfer_charts.hpp"

namespace hamjet::io {

namespace {

/// A deputy that drifts further than this beyond what is flown to is not followed to the end, for
/// the transfer would be a dot.
constexpr double most_spans_of_drift = 4;

}  // namespace

Chart rendezvous_chart(const RelativeTrajectory& trajectory, const std::vector<std::string>& axes) {
  const Eigen::Vector3d at_chief = Eigen::Vector3d::Zero();
  RelativeExtent extent;
  extent.include(trajectory.states);
  const bool has_chief = trajectory.states.empty() || extent.is_near(at_chief, most_spans_to_chief);
  const RelativeExtent transfer = extent;
  if (has_chief) extent.include(at_chief);
  const auto& unchanged = trajectory.unchanged;
  const auto first_away =
      std::find_if(unchanged.begin(), unchanged.end(), [&](const RelativeState& state) {
        return !trajectory.states.empty() && !extent.is_near(state.position_m, most_spans_of_drift);
      });
  const std::vector<RelativeState> drift(unchanged.begin(), first_away);
  extent.include(drift);
  const bool is_in_km = extent.largest_m() >= 1000;
  const auto usual = axis_letters(trajectory.frame);
  const std::vector<std::string> letters =
      axes.size() > 1 ? axes : std::vector<std::string>(usual.begin(), usual.end());
  Chart chart;
  chart.name = "rendezvous";
  chart.title =
      fmt::format("By itself and with two velocity changes, {} against {}", letters[0], letters[1]);
  chart.is_isometric = true;
  chart.x.label = fmt::format("{} ({})", letters[1], is_in_km ? "km" : "m");
  chart.y.label = fmt::format("{} ({})", letters[0], is_in_km ? "km" : "m");
  chart.x.margin = chart.y.margin = 0.05;
  const auto place = [&](const RelativeState& state) {
    const double unit = is_in_km ? 1e-3 : 1;
    return std::pair(state.position_m[1] * unit, state.position_m[0] * unit);
  };
  const auto add = [&](std::string title, std::size_t style,
                       const std::vector<RelativeState>& states, bool is_line) {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_line = is_line;
    curve.has_markers = !is_line;
    for (const RelativeState& state : states) curve.points.push_back(place(state));
    chart.curves.push_back(std::move(curve));
  };
  add(first_away == unchanged.end() ? "by itself" : "by itself, at first", 0, drift, true);
  add("with two velocity changes", 1, trajectory.states, true);
  if (!trajectory.states.empty()) {
    add("start", 3, {trajectory.states.front()}, false);
    add("end", 1, {trajectory.states.back()}, false);
  }
  if (has_chief) {
    add("chief", 2, {RelativeState{}}, false);
  } else {
    chart.title += "; " + far_chief_text(transfer);
  }
  chart.reading =
      "The deputy relative to the chief at the origin, as it flies: by itself over the scene's "
      "duration, and with the two changes of the least sum over the time of that transfer.";
  if (first_away != unchanged.end()) {
    chart.notes.push_back(fmt::format(
        "By itself it ends {} from its chief; the way there is drawn in part, so that the transfer "
        "can be seen.",
        length_text(unchanged.back().position_m.norm())));
  }
  return chart;
}

}  // namespace hamjet::io
