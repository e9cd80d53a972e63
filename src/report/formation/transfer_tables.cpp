#include "transfer_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "../../formats/relative_frame_text.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
#include "burn_view.hpp"
#include "feedback_errors_view.hpp"
#include "frame_columns.hpp"
#include "fuel_view.hpp"
#include "impulse_tables.hpp"
#include "thrust_view.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Point = const TransferPoint&;
using Change = Eigen::Vector3d TransferAnswer::*;

/// A condition, which may be infinite; none where it was not found, which is NaN.
std::optional<double> condition(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> times(const std::optional<double>& value, double unit) {
  return value ? std::optional(*value * unit) : std::nullopt;
}

/// What `value` makes of an answer; no value without an answer.
template <class Value>
auto of_answer(const TransferAnswer* answer, Value value) {
  return answer != nullptr ? std::optional(std::invoke(value, *answer)) : std::nullopt;
}

template <class Value>
auto of_shown(Value value) {
  return [value](Point point) { return of_answer(shown_answer(point), value); };
}

/// A column for each polynomial order, 1 to N.
template <class Value>
TableColumn& add_by_order(ResultTable<TransferPoint>& table, const Scene& scene, std::string name,
                          std::string unit, std::string meaning, Value value) {
  std::vector<std::string> parts;
  for (int order = 1; order <= scene.order; ++order) {
    parts.push_back(fmt::format("miss_m_order_{}", order));
  }
  return table.add_array(std::move(name), std::move(parts), std::move(unit), std::move(meaning),
                         [most = scene.order, value](Point point) {
                           std::vector<std::optional<double>> values;
                           for (int order = 1; order <= most; ++order) {
                             value(answer_of_order(point, order), values);
                           }
                           return values;
                         });
}

void add_change_by_order(ResultTable<TransferPoint>& table, const Scene& scene, std::string name,
                         std::string meaning, Change change) {
  const std::size_t count = told_coordinates(scene.system);
  TableColumn& column = add_by_order(
      table, scene, std::move(name), "m/s", std::move(meaning),
      [change, count](const TransferAnswer* answer, std::vector<std::optional<double>>& values) {
        for (std::size_t i = 0; i < count; ++i) {
          values.push_back(of_answer(answer, [&](const TransferAnswer& a) {
            return (a.*change)[static_cast<Eigen::Index>(i)];
          }));
        }
      });
  column.lengths = {static_cast<std::size_t>(scene.order), count};
  column.is_in_csv = column.is_in_json = false;
}

void add_orders(ResultTable<TransferPoint>& table, const Scene& scene) {
  const auto of_linear = [](auto value) {
    return [value](Point point) { return of_answer(answer_of_order(point, 1), value); };
  };
  table.add("linear_total_change_m_s", "m/s",
            "the sum of the magnitudes of both velocity changes of order 1",
            of_linear(&TransferAnswer::total_change_m_s));
  table.add("linear_miss_m", "m", "the miss of order 1", of_linear(&TransferAnswer::miss_m))
      .is_in_csv = false;
  add_by_order(table, scene, "miss_m_by_order", "m", "the misses of the orders 1 to N",
               [](const TransferAnswer* answer, std::vector<std::optional<double>>& values) {
                 values.push_back(of_answer(answer, &TransferAnswer::miss_m));
               });
  add_change_by_order(table, scene, "start_change_m_s_by_order",
                      "the velocity changes at the start, of the orders 1 to N",
                      &TransferAnswer::start_change_m_s);
  add_change_by_order(table, scene, "end_change_m_s_by_order",
                      "the velocity changes at the end, of the orders 1 to N",
                      &TransferAnswer::end_change_m_s);
}

void add_refinement(ResultTable<TransferPoint>& table) {
  const auto of_refined = [](auto value) {
    return [value](Point point) {
      return of_answer(point.is_refined() ? &*point.refined : nullptr, value);
    };
  };
  table.add("refined_total_change_m_s", "m/s",
            "the sum of both velocity changes of the answer that flying corrected",
            of_refined(&TransferAnswer::total_change_m_s));
  table.add("refined_miss_m", "m", "the miss of the answer that flying corrected",
            of_refined(&TransferAnswer::miss_m));
  table.add_if([](Point point) { return point.refined.has_value(); }, "refinement_flights", "",
               "the number of flights that the correction took",
               &TransferPoint::refinement_flights);
}

/// What holds for the whole study.
void add_scalars(ResultTable<TransferPoint>& table, const TransferResult& result) {
  const auto best = result.best_point();
  const std::size_t last = result.points.size() - 1;
  add_frame(table, result.scene.system, result.scene.transfer->frame, result.coordinates);
  table.add_scalar("verdict", "", "the outcome in words", transfer_verdict(result));
  table
      .add_scalar("best", "",
                  "index of the least change among those that count: within the tolerance, away "
                  "from singularities, and as the scene allows; nothing without one",
                  best)
      .is_in_json = false;  // summary.json has the row itself there
  table.add_scalar("is_first_or_last_time", "",
                   "whether the least velocity change is at the first or the last of the times",
                   best && last > 0 && (*best == 0 || *best == last));
  table.add_scalar("times_between_listed", "",
                   "the number of further times that were answered between the listed ones",
                   result.times_between);
  table.add_scalar("flight_floor_m", "m", "misses below this say nothing", result.flight_floor_m);
  table.add_scalar("chief_error_m", "m",
                   "the distance of the jet's chief from the flown one at the last time",
                   result.chief_error_m);
  table.add_scalar("largest_hamilton_jacobi_residual", "",
                   "the largest Hamilton-Jacobi residual of all times",
                   largest_hamilton_jacobi_residual(result));
  table.add_scalar("hamilton_jacobi_floor", "",
                   "the rounding floor of the Hamilton-Jacobi residual",
                   result.hamilton_jacobi_floor);
  table.add_scalar("steps", "", "the number of steps of the integration", result.statistics.steps);
  table.add_scalar("exit_code", "", "the exit code of the command",
                   static_cast<int>(exit_code(result)));
}

}  // namespace

ResultTable<TransferPoint> transfer_columns(const Scene& scene) {
  const double unit = scene.units.time_s;
  const double length_km = scene.units.length_km;
  const auto told_change = [count = told_coordinates(scene.system)](Change change) {
    return of_shown(
        [=](const TransferAnswer& answer) { return along_told_axes(answer.*change, count); });
  };
  const auto has_kind = [](Point point) { return point.kind.has_value(); };
  ResultTable<TransferPoint> table("transfers", "", {"times"},
                                   "Velocity changes of two impulses, one row a transfer time.");
  table.leave_rows_out_of_json();
  table.add("time_canonical", "",
            "the duration of the transfer, in the scene's canonical unit of time",
            [&scene](Point point) { return told_time(scene, point.time); });
  table.add("time_s", "s", "the duration of the transfer",
            [=](Point point) { return point.time * unit; });
  table.add_if(
      has_kind, "kind", "",
      "the generating function used; nothing where no kind exists, or in other coordinates",
      [&scene](Point point) { return told_kind(*point.kind, scene.system); });
  table.add("condition", "", "the condition of the linear part of that generating function",
            [](Point point) { return point.kind ? condition(point.condition) : std::nullopt; });
  table.add("position_condition", "",
            "the condition of the linear part of F1; infinite where positions cannot be commanded",
            [](Point point) { return condition(point.position_condition); });
  table.add("singular_distance_s", "s",
            "the time to the nearest singularity of F1; nothing without one",
            [=](Point point) { return times(point.singular_distance, unit); });
  table.add("near_singular", "",
            "whether the time is nearer to a singularity than the scene's margin",
            &TransferPoint::is_near_singular);
  table.add("beyond_tolerance", "", "whether the highest order misses by more than the tolerance",
            &TransferPoint::is_beyond_tolerance);
  table.add("answer", "",
            "the answer that the velocity changes belong to: the refined one, or that of an order",
            answer_name);
  table.add("exceeds_impulse", "", "whether an impulse is above the scene's largest_impulse_m_s",
            &TransferPoint::exceeds_impulse);
  table.add("keep_out_ratio", "",
            "the least of |(R/a, T/b, N/c)| on the way: below 1 it enters the scene's keep_out_m",
            &TransferPoint::keep_out_ratio);
  table.add("lowest_km", "km", "the least distance from the centre on the way",
            [=](Point point) { return times(point.lowest, length_km); });
  table.add("below_surface", "", "whether that is less than the check of the surface allows",
            &TransferPoint::is_below_surface);
  table.add_array("start_change_m_s", axis_parts(scene, "start_change_", "_m_s"), "m/s",
                  "the velocity change at the start, along the frame's axes",
                  told_change(&TransferAnswer::start_change_m_s));
  table.add_array("end_change_m_s", axis_parts(scene, "end_change_", "_m_s"), "m/s",
                  "the velocity change at the end, along the frame's axes",
                  told_change(&TransferAnswer::end_change_m_s));
  table.add("total_change_m_s", "m/s", "the sum of the magnitudes of both velocity changes",
            of_shown(&TransferAnswer::total_change_m_s));
  table
      .add("miss_m", "m", "the distance of the flown deputy from the wanted place",
           of_shown(&TransferAnswer::miss_m))
      .is_in_csv = false;
  add_orders(table, scene);
  add_refinement(table);
  table.add("hamilton_jacobi_residual", "",
            "the largest scaled residual of the Hamilton-Jacobi equation over all degrees",
            &TransferPoint::hamilton_jacobi_residual);
  table.add("end_drift_m_per_revolution", "m a revolution",
            "the drift along the track if nothing is done after the arrival", [](Point point) {
              return point.drift ? std::optional(point.drift->per_revolution_m) : std::nullopt;
            });
  table.add("failure", "", "the reason why there is no answer", failure_text);
  return table;
}

TableView transfers_table(const TransferResult& result) {
  ResultTable<TransferPoint> table = transfer_columns(result.scene);
  add_scalars(table, result);
  TableView view = std::move(table).view(result.points, {result.points.size()});
  if (const auto best = result.best_point()) view.places_of_rows = {{*best, "/best"}};
  return view;
}

TableView singular_times_table(const TransferResult& result) {
  using Singular = const SingularTime&;
  const double unit = result.scene.units.time_s;
  ResultTable<SingularTime> table("singular_times", "", {"singular_times"},
                                  "Times at which a generating function does not exist.");
  table.leave_rows_out_of_json();
  table.add("kind", "", "the kind of generating function; qqq-qqq is F1",
            [&](Singular singular) { return told_kind(singular.kind, result.scene.system); });
  table.add("time_canonical", "", "since the start, in the scene's canonical unit of time",
            [&](Singular singular) { return told_time(result.scene, singular.time); });
  table.add("time_s", "s", "since the start",
            [=](Singular singular) { return singular.time * unit; });
  table.add("resolution_s", "s", "how far the singular time may be wrong",
            [=](Singular singular) { return singular.resolution * unit; });
  table.add("smallest_ratio", "", "the smallest singular value over the largest",
            &SingularTime::smallest_ratio);
  table.add("second_ratio", "", "the second smallest singular value over the largest",
            &SingularTime::second_ratio);
  table.add("directions_lost", "",
            "the number of singular values that rounding cannot tell from zero",
            &SingularTime::directions_lost);
  const bool is_along_own = result.scene.transfer->frame == RelativeFrame::coordinates;
  std::vector<std::string> directions;
  for (const std::string& axis :
       axis_columns(result.scene.system,
                    is_along_own ? RelativeFrame::coordinates : RelativeFrame::inertial)) {
    directions.push_back("direction_inertial_" + axis);
  }
  table.add_array("direction_inertial", directions, "",
                  "the inertial unit vector of the direction that is not commanded; for F1 a "
                  "direction of the final position; along the coordinates of an own system",
                  [count = directions.size()](Singular singular) {
                    return along_told_axes(singular.direction, count);
                  });
  if (!is_along_own) {
    table.add_array("direction_rtn", {"direction_r", "direction_t", "direction_n"}, "",
                    "the same unit vector along the chief's R, T, N at that time; none along the "
                    "coordinates of an own system",
                    &SingularTime::direction_rtn);
  }
  TableView view = std::move(table).view(result.singular_times, {result.singular_times.size()});
  const std::string f1 = parse_kind("F1", 3).name();
  for (std::size_t i = 0; i < result.singular_times.size(); ++i) {
    if (result.singular_times[i].kind.name() != f1) continue;
    view.places_of_rows.emplace_back(
        i, fmt::format("/position_singular_times/{}", view.places_of_rows.size()));
  }
  return view;
}

TableView conditions_table(const TransferResult& result) {
  const KindConditions& conditions = result.conditions;
  std::vector<std::string> kinds;
  for (const GeneratingFunctionKind& kind : conditions.kinds) {
    kinds.push_back(told_kind(kind, result.scene.system));
  }
  ResultTable<std::size_t> table("conditions", "", {"times"},
                                 "Conditions of the linear parts of all kinds of generating "
                                 "functions along time.");
  table.leave_rows_out_of_json();
  table.add("time_canonical", "", "since the start, in the scene's canonical unit of time",
            [&](std::size_t i) { return told_time(result.scene, conditions.times[i]); });
  table.add("time_s", "s", "since the start",
            [&](std::size_t i) { return conditions.times[i] * result.scene.units.time_s; });
  table.add_array("condition", kinds, "",
                  "the condition of each kind; infinite where it is singular", [&](std::size_t i) {
                    std::vector<std::optional<double>> values;
                    for (const double value : conditions.values[i]) {
                      values.push_back(condition(value));
                    }
                    return values;
                  });
  table.add_scalars("kinds", "", "the names of the kinds of generating functions", kinds)
      .is_in_json = false;
  std::vector<std::size_t> rows(conditions.times.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return std::move(table).view(rows, {rows.size()});
}

TableView budget_windows_table(const TransferResult& result) {
  using Window = const BudgetWindow&;
  const double unit = result.scene.units.time_s;
  ResultTable<BudgetWindow> table("budget_windows", "", {"budget_windows"},
                                  "Spans of transfer times that take no more than the budget.");
  table.add("first_s", "s", "the time at which the window begins",
            [=](Window window) { return window.first * unit; });
  table.add("last_s", "s", "the time at which the window ends",
            [=](Window window) { return window.last * unit; });
  table.add("begins_at_first_time", "", "whether the window begins before the times searched",
            &BudgetWindow::begins_before);
  table.add("ends_at_last_time", "", "whether the window ends after the times searched",
            &BudgetWindow::ends_after);
  table.keep_in_csv({});
  return std::move(table).view(result.budget_windows, {result.budget_windows.size()});
}

std::vector<TableView> transfer_tables(const TransferResult& result) {
  return {transfers_table(result),
          singular_times_table(result),
          conditions_table(result),
          budget_windows_table(result),
          optimal_impulses_table(result),
          least_by_time_table(result),
          waypoint_impulses_table(result),
          total_by_time_table(result),
          energy_optimal_table(result),
          thrust_profile_table(result),
          feedback_table(result),
          feedback_errors_table(result),
          feedback_samples_table(result),
          fuel_optimal_table(result),
          fuel_optimal_burns_table(result),
          primer_profile_table(result),
          burns_table(result)};
}

}  // namespace hamjet::io
