#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "answer_columns.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// A condition, which may be infinite; empty where it was not found, which is NaN.
std::string condition(double value) { return std::isnan(value) ? "" : csv_number(value); }

using TransferColumns = Columns<TransferPoint>;
using Point = const TransferPoint&;

void add_orders(TransferColumns& columns, int most) {
  columns.add("linear_total_change_m_s", [](Point point) {
    const TransferAnswer* linear = answer_of_order(point, 1);
    return linear != nullptr ? std::optional(linear->total_change_m_s()) : std::nullopt;
  });
  for (int order = 1; order <= most; ++order) {
    columns.add(fmt::format("miss_m_order_{}", order), [order](Point point) {
      const TransferAnswer* answer = answer_of_order(point, order);
      return answer != nullptr ? std::optional(answer->miss_m) : std::nullopt;
    });
  }
}

void add_refinement(TransferColumns& columns) {
  const auto is_refined = [](Point point) { return point.refined.has_value(); };
  const auto is_found = [](Point point) {
    return point.refined.has_value() && point.refined->failure.empty();
  };
  columns.add_if(is_found, "refined_total_change_m_s",
                 [](Point point) { return point.refined->total_change_m_s(); });
  columns.add_if(is_found, "refined_miss_m", [](Point point) { return point.refined->miss_m; });
  columns.add_if(is_refined, "refinement_flights", &TransferPoint::refinement_flights);
}

}  // namespace

std::string transfers_csv(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  const double length_km = result.scene.units.length_km;
  const auto has_kind = [](Point point) { return point.kind.has_value(); };
  TransferColumns columns;
  columns.add("time_canonical", [&](Point point) { return told_time(result.scene, point.time); });
  columns.add("time_s", [=](Point point) { return point.time * unit; });
  columns.add_if(has_kind, "kind", [](Point point) { return point.kind->name(); });
  columns.add_if(has_kind, "condition", [](Point point) { return condition(point.condition); });
  columns.add("position_condition",
              [](Point point) { return condition(point.position_condition); });
  columns.add_if([](Point point) { return point.singular_distance.has_value(); },
                 "singular_distance_s",
                 [=](Point point) { return *point.singular_distance * unit; });
  columns.add("near_singular", &TransferPoint::is_near_singular);
  columns.add("beyond_tolerance", &TransferPoint::is_beyond_tolerance);
  columns.add("answer", answer_name);
  columns.add("exceeds_impulse", &TransferPoint::exceeds_impulse);
  columns.add("keep_out_ratio", &TransferPoint::keep_out_ratio);
  columns.add_if([](Point point) { return point.lowest.has_value(); }, "lowest_km",
                 [=](Point point) { return *point.lowest * length_km; });
  columns.add("below_surface", &TransferPoint::is_below_surface);
  add_answer_columns<TransferPoint>(columns, result.scene.transfer->frame,
                                    [](Point point) -> Point { return point; });
  add_orders(columns, result.scene.order);
  add_refinement(columns);
  columns.add("hamilton_jacobi_residual", &TransferPoint::hamilton_jacobi_residual);
  columns.add_if([](Point point) { return point.drift.has_value(); }, "end_drift_m_per_revolution",
                 [](Point point) { return point.drift->per_revolution_m; });
  columns.add("failure", failure_text);
  return columns.csv(result.points);
}

std::string singular_times_csv(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  using Singular = const SingularTime&;
  Columns<SingularTime> columns;
  columns.add("kind", [](Singular singular) { return singular.kind.name(); });
  columns.add("time_canonical",
              [&](Singular singular) { return told_time(result.scene, singular.time); });
  columns.add("time_s", [=](Singular singular) { return singular.time * unit; });
  columns.add("resolution_s", [=](Singular singular) { return singular.resolution * unit; });
  columns.add("smallest_ratio", &SingularTime::smallest_ratio);
  columns.add("second_ratio", &SingularTime::second_ratio);
  columns.add("directions_lost", &SingularTime::directions_lost);
  for (const Eigen::Index i : {0, 1, 2}) {
    columns.add(fmt::format("direction_inertial_{}", "xyz"[i]),
                [=](Singular singular) { return singular.direction[i]; });
  }
  for (const Eigen::Index i : {0, 1, 2}) {
    columns.add_if([](Singular singular) { return singular.direction_rtn.has_value(); },
                   fmt::format("direction_{}", "rtn"[i]),
                   [=](Singular singular) { return (*singular.direction_rtn)[i]; });
  }
  return columns.csv(result.singular_times);
}

std::string conditions_csv(const TransferResult& result) {
  const KindConditions& conditions = result.conditions;
  std::string text = "time_canonical,time_s";
  for (const GeneratingFunctionKind& kind : conditions.kinds) text += "," + kind.name();
  text += "\n";
  for (std::size_t i = 0; i < conditions.times.size(); ++i) {
    text += csv_number(told_time(result.scene, conditions.times[i])) + "," +
            csv_number(conditions.times[i] * result.scene.units.time_s);
    for (const double value : conditions.values[i]) text += "," + condition(value);
    text += "\n";
  }
  return text;
}

}  // namespace hamjet::io
