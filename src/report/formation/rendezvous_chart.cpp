#include <fmt/format.h>

#include <algorithm>

#include "../../formats/relative_frame_text.hpp"
#include "transfer_charts.hpp"

namespace hamjet::io {

Chart rendezvous_chart(const RelativeTrajectory& trajectory) {
  double largest_m = 0;
  for (const auto* states : {&trajectory.states, &trajectory.unchanged}) {
    for (const RelativeState& state : *states) {
      largest_m = std::max(largest_m, state.position_m.cwiseAbs().maxCoeff());
    }
  }
  const bool is_in_km = largest_m >= 1000;
  const auto letters = axis_letters(trajectory.frame);
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
  add("by itself", 0, trajectory.unchanged, true);
  add("with two velocity changes", 1, trajectory.states, true);
  if (!trajectory.states.empty()) {
    add("start", 3, {trajectory.states.front()}, false);
    add("end", 1, {trajectory.states.back()}, false);
  }
  add("chief", 2, {RelativeState{}}, false);
  chart.reading =
      "The deputy relative to the chief at the origin, as it flies: by itself over the scene's "
      "duration, and with the two changes of the least sum over the time of that transfer.";
  return chart;
}

}  // namespace hamjet::io
