#include "transfer_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "../../studies/formation/charts/free_coordinates.hpp"
#include "../../text/html_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// With fewer points a line alone would hide where they are.
constexpr std::size_t fewest_points_without_markers = 25;

TimeAxis axis_of(const TransferResult& result) {
  return time_axis(result.scene.transfer->times.back() * result.scene.units.time_s);
}

/// A canonical unit of time in the axis's unit.
double time_unit(const TransferResult& result) {
  return result.scene.units.time_s / axis_of(result).seconds;
}

/// An empty chart over the transfer times, with what is singular shaded.
Chart chart_over_time(const TransferResult& result, std::string name, std::string title) {
  Chart chart;
  chart.name = std::move(name);
  chart.title = std::move(title);
  chart.x.label = fmt::format("transfer time ({})", axis_of(result).name);
  add_revolutions(result.scene, axis_of(result).seconds, chart.x);
  const double unit = time_unit(result);
  const double margin = result.scene.transfer->singular_margin;
  for (const SingularTime& singular : result.position_singularities()) {
    chart.bands.push_back({(singular.time - margin) * unit, (singular.time + margin) * unit});
  }
  return chart;
}

/// Whether there is a time between the two, which may go backwards, at which F1 does not exist.
bool is_singular_between(const std::vector<SingularTime>& singular, double first, double second) {
  return std::any_of(singular.begin(), singular.end(), [&](const SingularTime& one) {
    return std::min(first, second) < one.time && one.time < std::max(first, second);
  });
}

/// A line over the transfer times; `measure` gives a point's value, or none, which breaks it, as
/// does a time between two points at which F1 does not exist.
template <class Measure>
ChartCurve curve_over_time(const TransferResult& result, std::string title, std::size_t style,
                           Measure measure) {
  ChartCurve curve;
  curve.title = std::move(title);
  curve.style = style;
  curve.has_markers = result.points.size() < fewest_points_without_markers;
  const std::vector<SingularTime> singular = result.position_singularities();
  double previous = result.points.empty() ? 0 : result.points.front().time;
  for (const TransferPoint& point : result.points) {
    if (is_singular_between(singular, previous, point.time)) {
      curve.gaps.push_back(curve.points.size());
    }
    previous = point.time;
    if (const std::optional<double> value = measure(point)) {
      curve.points.emplace_back(point.time * time_unit(result), *value);
    } else {
      curve.gaps.push_back(curve.points.size());
    }
  }
  return curve;
}

/// Hollow markers on the line of the total change.
template <class Condition>
ChartCurve marks(const TransferResult& result, std::string title, std::size_t style,
                 Condition has_mark) {
  ChartCurve curve = curve_over_time(result, std::move(title), style,
                                     [&](const TransferPoint& point) -> std::optional<double> {
                                       const TransferAnswer* answer = shown_answer(point);
                                       if (answer == nullptr || !has_mark(point)) return {};
                                       return answer->total_change_m_s();
                                     });
  curve.has_line = false;
  curve.has_markers = true;
  curve.is_filled = false;
  return curve;
}

/// Hollow markers in place of the line, few enough to be told apart, which leave a line visible
/// that runs through them.
void show_beside_line(ChartCurve& curve) {
  constexpr std::size_t most_markers = 120;
  const std::size_t interval = (curve.points.size() + most_markers - 1) / most_markers;
  std::vector<std::pair<double, double>> kept;
  for (std::size_t i = 0; i < curve.points.size(); i += interval) kept.push_back(curve.points[i]);
  curve.points = std::move(kept);
  curve.gaps.clear();
  curve.has_line = false;
  curve.has_markers = true;
  curve.is_filled = false;
}

constexpr const char* shading =
    " Shaded: nearer than the scene's margin to a time at which F1 does not exist, where no "
    "initial velocity commands the final position in one direction of space; lines are broken at "
    "that time.";

/// Says how often lines are broken for want of an answer.
void note_unanswered(const TransferResult& result, Chart& chart) {
  const auto count =
      std::count_if(result.points.begin(), result.points.end(),
                    [](const auto& point) { return shown_answer(point) == nullptr; });
  if (count == 0) return;
  chart.notes.push_back(fmt::format(
      "Lines are also broken at transfer times without an answer: {}; the table says why.", count));
}

}  // namespace

Chart velocity_change_chart(const TransferResult& result) {
  Chart chart = chart_over_time(result, "velocity-change", "Velocity change against transfer time");
  chart.y = logarithmic_axis("velocity change (m/s)");
  const bool is_refined = result.scene.transfer->refine;
  const auto part = [](auto measure) {
    return [measure](const TransferPoint& point) -> std::optional<double> {
      const TransferAnswer* answer = shown_answer(point);
      if (answer == nullptr) return std::nullopt;
      return measure(*answer);
    };
  };
  chart.curves.push_back(curve_over_time(
      result, "both impulses", 0,
      part([](const TransferAnswer& answer) { return answer.total_change_m_s(); })));
  chart.curves.push_back(curve_over_time(
      result, "first impulse", 3,
      part([](const TransferAnswer& answer) { return answer.start_change_m_s.norm(); })));
  chart.curves.push_back(curve_over_time(
      result, "second impulse", 4,
      part([](const TransferAnswer& answer) { return answer.end_change_m_s.norm(); })));
  if (result.scene.order > 1) {
    // The linear theory is drawn behind the line and only where it is worse: elsewhere the two
    // would cover each other.
    constexpr double as_good = 0.01;
    ChartCurve linear = curve_over_time(
        result, "both, linear answer", 1, [](const TransferPoint& point) -> std::optional<double> {
          const TransferAnswer* answer = answer_of_order(point, 1);
          const TransferAnswer* shown = shown_answer(point);
          if (answer == nullptr) return std::nullopt;
          const double change = answer->total_change_m_s();
          const bool is_as_good =
              shown != nullptr && std::abs(change / shown->total_change_m_s() - 1) <= as_good;
          return is_as_good ? std::nullopt : std::optional(change);
        });
    show_beside_line(linear);
    chart.curves.insert(chart.curves.begin(), std::move(linear));
  }
  chart.curves.push_back(marks(result, "near a singularity", 7,
                               [](const TransferPoint& point) { return point.is_near_singular; }));
  chart.curves.push_back(marks(result,
                               fmt::format("order {} misses by more than {}", result.scene.order,
                                           length_text(result.scene.transfer->tolerance_m)),
                               6, [](const TransferPoint& point) {
                                 return point.is_beyond_tolerance && !point.is_near_singular;
                               }));
  if (result.optimal) {
    ChartCurve optimal;
    optimal.title = "optimal impulses, linear theory";
    optimal.style = 2;
    for (const LeastChange& one : result.optimal->by_time) {
      if (!one.change_m_s) continue;
      optimal.points.emplace_back(one.time * time_unit(result), *one.change_m_s);
    }
    chart.curves.push_back(std::move(optimal));
    if (result.optimal->is_found()) {
      ChartCurve plan;
      plan.title = "optimal plan, flown";
      plan.style = 3;
      plan.has_line = false;
      plan.points.emplace_back(result.optimal->plan->duration * time_unit(result),
                               result.optimal->plan->total_change_m_s());
      chart.curves.push_back(std::move(plan));
    }
    chart.notes.emplace_back(
        "Optimal impulses along time are those of the linear theory about the "
        "chief, which may not hold so far from it.");
  }
  if (const auto best = result.best_point()) {
    chart.rules.push_back({true, result.points[*best].time * time_unit(result), "least"});
  }
  chart.reading = fmt::format(
      "What leaving the start and stopping at the end costs together, for every transfer time: the "
      "magnitudes of both impulses and their sum, of the {}; hollow markers are the sum of the "
      "linear answer where it differs by more than a hundredth. The vertical line is the least "
      "sum, among answers that come within the tolerance and are not near a singularity.{}",
      is_refined ? "answer that flying refined (where that failed, of the highest order)"
                 : fmt::format("polynomials of order {}", result.scene.order),
      shading);
  note_unanswered(result, chart);
  return chart;
}

Chart miss_chart(const TransferResult& result) {
  Chart chart = chart_over_time(result, "miss-time", "Miss of each order");
  chart.y = logarithmic_axis("distance from the wanted end", AxisUnit::metres);
  for (int order = 1; order <= result.scene.order; ++order) {
    chart.curves.push_back(
        curve_over_time(result, fmt::format("order {}", order), static_cast<std::size_t>(order - 1),
                        [&](const TransferPoint& point) -> std::optional<double> {
                          const auto* answer = answer_of_order(point, order);
                          if (answer == nullptr) return std::nullopt;
                          return answer->miss_m;
                        }));
  }
  if (result.scene.transfer->refine) {
    chart.curves.push_back(curve_over_time(result, "refined",
                                           static_cast<std::size_t>(result.scene.order),
                                           [](const TransferPoint& point) -> std::optional<double> {
                                             if (!point.refined || !point.refined->failure.empty())
                                               return std::nullopt;
                                             return point.refined->miss_m;
                                           }));
  }
  chart.rules.push_back(
      {false, result.scene.transfer->tolerance_m,
       fmt::format("tolerance: {}", length_text(result.scene.transfer->tolerance_m))});
  chart.y.floor = result.flight_floor_m;
  chart.y.floor_name = "the rounding of the flights";
  chart.reading = fmt::format(
      "Every answer is proved: a deputy flies it with the full equations of motion, and its "
      "distance from the wanted end is drawn, one line for each order of the polynomials. A miss "
      "below {}, the rounding of the flights, says nothing.{}",
      length_text(result.flight_floor_m), shading);
  note_unanswered(result, chart);
  return chart;
}

Chart condition_chart(const TransferResult& result) {
  Chart chart = chart_over_time(result, "kind-conditions", "Condition of the kinds along time");
  chart.y = logarithmic_axis("condition of the linear part");
  const double unit = time_unit(result);
  const KindConditions& conditions = result.conditions;
  const auto curve_of = [&](std::string title, std::size_t style, auto measure) {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_markers = conditions.times.size() < fewest_points_without_markers;
    for (std::size_t i = 0; i < conditions.times.size(); ++i) {
      curve.points.emplace_back(conditions.times[i] * unit, measure(conditions.values[i]));
    }
    return curve;
  };
  constexpr std::array<const char*, 4> names = {"F1", "F2", "F3", "F4"};
  for (std::size_t n = 0; n < names.size(); ++n) {
    const SystemSettings& system = result.scene.system;
    const std::string wanted = parse_kind(names[n], told_coordinates(system)).name();
    const auto place = std::find_if(
        conditions.kinds.begin(), conditions.kinds.end(),
        [&](const GeneratingFunctionKind& kind) { return told_kind(kind, system) == wanted; });
    if (place == conditions.kinds.end()) continue;
    const GeneratingFunctionKind& kind = *place;
    const auto k = static_cast<std::size_t>(place - conditions.kinds.begin());
    chart.curves.push_back(
        curve_of(names[n], n, [k](const std::vector<double>& values) { return values[k]; }));
    for (const SingularTime& singular : result.singular_times) {
      if (singular.kind == kind) chart.curves.back().ticks.push_back(singular.time * unit);
    }
  }
  chart.curves.push_back(curve_of(fmt::format("best of all {}", conditions.kinds.size()), 4,
                                  [](const std::vector<double>& values) {
                                    return *std::min_element(values.begin(), values.end());
                                  }));
  chart.curves.back().has_line = true;
  chart.reading =
      "A generating function exists where the block of the linear flow that it inverts is regular; "
      "its condition number says by how much errors grow in the inversion, and is infinite where "
      "the kind does not exist. A short stroke at the lower edge in a line's colour marks each "
      "such time. Where F1 fails, another kind exists (lowest line); but a final position that "
      "cannot be commanded is not made commandable by it. The kind \"auto\" is not the one of the "
      "lowest line: it is the one whose inverted block changes least over the transfer, for its "
      "polynomials decay fastest.";
  return chart;
}

}  // namespace hamjet::io
