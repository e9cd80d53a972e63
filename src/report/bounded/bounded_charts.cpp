#include "bounded_charts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "../../text/quantity_text.hpp"

namespace hamjet::io {
namespace {

/// An axis across and one upwards, of R, T, N: from above the orbit's plane, from behind the centre
/// and along the motion.
struct Plane {
  Eigen::Index across;
  Eigen::Index upwards;
};
constexpr std::array<Plane, 3> planes = {{{1, 0}, {1, 2}, {0, 2}}};
constexpr std::array<char, 3> letters = {'R', 'T', 'N'};

}  // namespace

Chart bounded_drift_chart(const BoundedFormation& formation) {
  Chart chart;
  chart.name = "bounded-drift";
  chart.title = "Drift that is left";
  chart.x = logarithmic_axis("size of the relative orbit", AxisUnit::metres);
  chart.y = logarithmic_axis("mean drift along the track (parts of the size a revolution)");
  chart.reading = fmt::format(
      "Deputies of each rule and size, flown beside the chief over {} with the whole field; the "
      "slope of the straight line through the differences between the times at which both pass the "
      "chief's mean argument of latitude and between their nodes then, as a length in parts of the "
      "size.",
      counted(formation.revolutions, "revolution"));
  for (std::size_t r = 0; r < bounded_rules.size(); ++r) {
    ChartCurve curve;
    curve.title = std::string(name_of(bounded_rules[r]));
    curve.style = r;
    for (const BoundedDeputy& deputy : formation.deputies) {
      if (deputy.rule != bounded_rules[r] || !deputy.failure.empty()) continue;
      curve.points.emplace_back(deputy.size_m, std::abs(deputy.drifts.back().along));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

std::vector<Chart> bounded_orbit_charts(const BoundedFormation& formation) {
  std::vector<Chart> charts;
  const BoundedDeputy* largest = nullptr;
  for (const BoundedDeputy& deputy : formation.deputies) {
    if (deputy.rule != BoundedRule::poincare_map || !deputy.failure.empty()) continue;
    if (largest == nullptr || deputy.size_m > largest->size_m) largest = &deputy;
  }
  for (const Plane& plane : planes) {
    const auto letter = [](Eigen::Index axis) { return letters[static_cast<std::size_t>(axis)]; };
    Chart chart;
    chart.name = fmt::format("bounded-{}{}", letter(plane.across), letter(plane.upwards));
    chart.title = fmt::format("{} against {}", letter(plane.upwards), letter(plane.across));
    chart.is_isometric = true;
    chart.is_panel = true;
    chart.x.label = fmt::format("{} (sizes)", letter(plane.across));
    chart.y.label = fmt::format("{} (sizes)", letter(plane.upwards));
    chart.x.margin = chart.y.margin = 0.05;
    chart.x.includes = chart.y.includes = {-1, 1};
    const auto add = [&](const BoundedDeputy& deputy, const std::vector<RelativeState>& states,
                         std::string title, std::size_t style) {
      ChartCurve curve = unmarked_line(std::move(title), style);
      for (const RelativeState& state : states) {
        curve.points.emplace_back(state.position_m[plane.across] / deputy.size_m,
                                  state.position_m[plane.upwards] / deputy.size_m);
      }
      chart.curves.push_back(std::move(curve));
    };
    std::size_t style = 0;
    for (const BoundedDeputy& deputy : formation.deputies) {
      if (deputy.rule != BoundedRule::poincare_map || !deputy.failure.empty()) continue;
      add(deputy, deputy.first, length_text(deputy.wanted_m), style++);
    }
    if (largest != nullptr) {
      add(*largest, largest->last,
          fmt::format("{}, revolution {}", length_text(largest->wanted_m),
                      formation.revolutions + 1),
          style++);
    }
    ChartCurve chief;
    chief.title = "chief";
    chief.style = style;
    chief.has_line = false;
    chief.points = {{0, 0}};
    chart.curves.push_back(std::move(chief));
    charts.push_back(std::move(chart));
  }
  charts.front().reading =
      "The relative orbits of the family, each divided by its size, as they were flown over the "
      "first revolution, and that of the largest one after the window: R points away from the "
      "centre of the Earth, T along the motion, N along the orbit's angular momentum.";
  return charts;
}

}  // namespace hamjet::io
