#include "optimal_control_charts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {
namespace {

/// Markers show the steps only while they can be told apart.
int marker_interval(const ChartCurve& curve) {
  return std::max(1, static_cast<int>(curve.points.size() / 40));
}

/// Every how many of the steps is drawn: more points than that cannot be told apart.
std::size_t drawn_interval(std::size_t steps) { return std::max<std::size_t>(1, steps / 2000); }

Chart trajectory_chart(const OptimalControlResult& result) {
  const auto& names = state_names(result.study.model);
  Chart chart;
  chart.name = "trajectory";
  chart.title = fmt::format("Trajectory in the plane of {} and {}", names[0], names[1]);
  chart.is_isometric = result.study.model == ControlModel::heisenberg;  // both are lengths
  chart.x.label = names[0];
  chart.y.label = names[1];
  chart.x.margin = chart.y.margin = 0.05;
  ChartCurve curve;
  curve.title = fmt::format("{} steps", result.study.steps);
  const auto& states = result.solution.trajectory.states;
  for (std::size_t k = 0; k < states.size(); k += drawn_interval(states.size())) {
    curve.points.emplace_back(states[k](0), states[k](1));
  }
  curve.marker_interval = marker_interval(curve);
  chart.curves.push_back(curve);
  for (const bool is_end : {false, true}) {
    ChartCurve place;
    place.title = is_end ? "end" : "start";
    place.style = is_end ? 2 : 1;
    place.has_line = false;
    const Eigen::VectorXd& x = is_end ? states.back() : states.front();
    place.is_filled = is_end;
    place.points.emplace_back(x(0), x(1));
    chart.curves.push_back(place);
  }
  return chart;
}

Chart control_chart(const OptimalControlResult& result) {
  const OptimalControlStudy& study = result.study;
  const auto& controls = result.solution.trajectory.controls;
  const double step = study.duration / static_cast<double>(study.steps);
  Chart chart;
  chart.name = "controls";
  chart.title = "Controls along time";
  chart.x.label = "time";
  chart.y.label = "control";
  chart.x.includes = {0, study.duration};
  chart.y.margin = 0.05;
  for (std::size_t j = 0; j < control_count(study.model); ++j) {
    ChartCurve curve;
    curve.title = control_count(study.model) > 1 ? fmt::format("u_{}", j + 1) : "u";
    curve.style = j;
    for (std::size_t k = 0; k < controls.size(); k += drawn_interval(controls.size())) {
      const double time = (static_cast<double>(k) + state_weight(study.discretization)) * step;
      curve.points.emplace_back(time, controls[k](static_cast<Eigen::Index>(j)));
    }
    curve.marker_interval = marker_interval(curve);
    chart.curves.push_back(curve);
  }
  return chart;
}

Chart cost_chart(const OptimalControlResult& result) {
  Chart chart;
  chart.name = "cost";
  chart.title = "Error of the cost against the step";
  chart.x = logarithmic_axis("step");
  chart.y = logarithmic_axis("cost: relative error from the closed form");
  chart.x.margin = chart.y.margin = 0.05;
  chart.y.floor = rounding_of(Precision::double_precision);
  chart.y.floor_name = "the rounding of double precision";
  ChartCurve continuous;
  continuous.title =
      result.fit ? fmt::format("continuous: order {:.2f}", result.fit->order) : "continuous";
  ChartCurve discrete;
  discrete.title = "with the same steps";
  discrete.style = 1;
  discrete.has_line = false;
  for (const ControlConvergencePoint& point : result.convergence) {
    const double step = result.study.duration / static_cast<double>(point.steps);
    if (point.continuous_error) continuous.points.emplace_back(step, *point.continuous_error);
    if (point.discrete_error) discrete.points.emplace_back(step, *point.discrete_error);
  }
  std::sort(continuous.points.begin(), continuous.points.end());
  chart.curves = {continuous, discrete};
  return chart;
}

}  // namespace

std::vector<Chart> optimal_control_charts(const OptimalControlResult& result) {
  return {trajectory_chart(result), control_chart(result), cost_chart(result)};
}

}  // namespace hamjet::io
