#include "canonical_transformation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamjet/studies/scene.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t most_points = 2000;

using Point = CanonicalTransformationPoint;

/// A curve for each run; `place` gives a point's coordinates.
template <class Place>
void add_curves(const CanonicalTransformationResult& result, Chart& chart,
                const std::string& suffix, std::size_t first_style, bool has_line, Place place) {
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const CanonicalTransformationRun& run = result.runs[i];
    ChartCurve curve;
    curve.title = fmt::format("step {:g}{}", run.requested_step, suffix);
    curve.style = first_style + i;
    curve.has_line = has_line;
    curve.has_markers = !has_line;
    curve.is_filled = false;
    const std::size_t every = (run.trajectory.size() + most_points - 1) / most_points;
    for (std::size_t k = 0; k < run.trajectory.size(); k += std::max<std::size_t>(every, 1)) {
      curve.points.push_back(place(run.trajectory[k]));
    }
    chart.curves.push_back(curve);
  }
}

Chart phase_plane_chart(const CanonicalTransformationResult& result, bool is_transformed) {
  const std::size_t n = result.study.nominal.size() / 2;
  const std::string index = n == 1 ? "" : "1";
  Chart chart;
  chart.name = is_transformed ? "transformed-plane" : "original-plane";
  chart.title = is_transformed ? "Trajectory in the transformed coordinates"
                               : "Trajectory in the original coordinates";
  chart.x.label = fmt::format("{}{} (canonical)", is_transformed ? "Q" : "q", index);
  chart.y.label = fmt::format("{}{} (canonical)", is_transformed ? "P" : "p", index);
  chart.x.margin = chart.y.margin = 0.04;
  chart.is_isometric = true;  // a rotation keeps its shape
  add_curves(result, chart, "", 0, true, [&](const Point& point) {
    const std::vector<double>& state = is_transformed ? point.transformed : point.original;
    return std::pair(state[0], state[n]);
  });
  return chart;
}

Chart energy_chart(const CanonicalTransformationResult& result) {
  Chart chart;
  chart.name = "energy-error";
  chart.title = "Energy error in both coordinates";
  chart.x.label = "time (canonical)";
  chart.y.label = "energy - energy at the start (canonical)";
  chart.y.margin = 0.04;
  add_curves(result, chart, ", z", 0, true,
             [](const Point& point) { return std::pair(point.time, point.energy_error); });
  // Few enough markers for the line below them to be seen.
  const std::size_t lines = chart.curves.size();
  add_curves(result, chart, ", Z", lines, false, [](const Point& point) {
    return std::pair(point.time, point.transformed_energy_error);
  });
  for (std::size_t i = lines; i < chart.curves.size(); ++i) {
    auto& points = chart.curves[i].points;
    const std::size_t every = std::max<std::size_t>(1, points.size() / 60);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.size(); k += every) points[kept++] = points[k];
    points.resize(kept);
  }
  return chart;
}

Chart difference_chart(const CanonicalTransformationResult& result) {
  Chart chart;
  chart.name = "energy-difference";
  chart.title = "Difference of the energy errors of the two coordinates";
  chart.x.label = "time (canonical)";
  chart.y = logarithmic_axis("|difference of the energy errors|");
  chart.y.floor = rounding_of(Precision::double_precision);
  chart.y.floor_name = "the rounding of double precision";
  add_curves(result, chart, "", 0, false, [](const Point& point) {
    return std::pair(point.time, std::abs(point.transformed_energy_error - point.energy_error));
  });
  return chart;
}

}  // namespace

std::vector<Chart> canonical_transformation_charts(const CanonicalTransformationResult& result) {
  return {phase_plane_chart(result, false), phase_plane_chart(result, true), energy_chart(result),
          difference_chart(result)};
}

}  // namespace hamjet::io
